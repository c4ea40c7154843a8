#include "poinsot/base/archive.h"

#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

enum class Colour : std::uint8_t { red, green, blue };

struct Padded {
  bool flag = false;
  double x = 0;
  Colour colour = Colour::red;
  std::vector<std::string> words;

  bool operator==(const Padded&) const = default;
  template <class Archive>
  void archive(Archive& with) {
    with(flag, x, words);
    with.choice(colour, Colour::blue);
  }
};

struct Free {
  int n = 0;
};
template <class Archive>
void archive(Archive& with, Free& value) {
  with(value.n);
}

template <class T>
T back(const T& value) {
  ByteWriter out;
  out(value);
  ByteReader in(out.bytes());
  T read{};
  in(read);
  EXPECT_EQ(in.left(), 0u);
  return read;
}

ByteReader reader(const std::vector<std::byte>& bytes) {
  return ByteReader(bytes);
}

TEST(Archive, NumbersComeBackToTheBit) {
  EXPECT_EQ(back(-7), -7);
  EXPECT_TRUE(back(true));
  EXPECT_TRUE(std::signbit(back(-0.0)));
  EXPECT_TRUE(std::isnan(back(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(back(std::uint64_t{1} << 63), std::uint64_t{1} << 63);
}

TEST(Archive, ContainersComeBack) {
  EXPECT_EQ(back(std::string("a\0b", 3)), std::string("a\0b", 3));
  EXPECT_EQ(back(std::vector<double>{1, 2.5}), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(back(std::array<int, 3>{1, 2, 3}), (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(back(std::optional<int>()), std::nullopt);
  EXPECT_EQ(back(std::optional<int>(4)), 4);
  using Either = std::variant<int, std::string>;
  EXPECT_EQ(back(Either("word")), Either("word"));
  EXPECT_EQ(back(std::vector<std::vector<int>>{{1}, {}, {2, 3}}),
            (std::vector<std::vector<int>>{{1}, {}, {2, 3}}));
}

TEST(Archive, MatricesAndQuaternionsComeBack) {
  const Eigen::Matrix3d fixed = Eigen::Matrix3d::Random();
  EXPECT_EQ(back(fixed), fixed);
  const Eigen::Matrix<double, 13, Eigen::Dynamic> grown =
      Eigen::Matrix<double, 13, Eigen::Dynamic>::Random(13, 5);
  EXPECT_EQ(back(grown), grown);
  const Eigen::Quaterniond q(1, 2, 3, 4);
  EXPECT_EQ(back(q).coeffs(), q.coeffs());
}

TEST(Archive, StructsAreTakenApartByMemberOrFunction) {
  const Padded value{true, 2, Colour::blue, {"one", "two"}};
  EXPECT_EQ(back(value), value);
  EXPECT_EQ(back(Free{3}).n, 3);
}

TEST(Archive, PaddingIsNotAmongTheBytes) {
  alignas(Padded) std::byte ones[sizeof(Padded)], zeros[sizeof(Padded)];
  std::memset(ones, 0xff, sizeof ones);
  std::memset(zeros, 0, sizeof zeros);
  auto* const a = new (ones) Padded{true, 1, Colour::green, {}};
  auto* const b = new (zeros) Padded{true, 1, Colour::green, {}};
  ByteWriter first, second;
  first(*a);
  second(*b);
  EXPECT_EQ(first.bytes(), second.bytes());
  a->~Padded();
  b->~Padded();
}

TEST(Archive, SomeElementsAreWrittenAndTheOthersReset) {
  for (const std::size_t n : {0u, 1u, 7u, 8u, 9u, 20u}) {
    std::vector<int> values(n);
    for (std::size_t k = 0; k < n; ++k) values[k] = static_cast<int>(k % 3);
    ByteWriter out;
    out.some(values, [&](std::size_t k) { return values[k] != 0; });
    std::vector<int> read(n, 9);
    ByteReader in(out.bytes());
    in.some(read, [](std::size_t) { return false; });
    EXPECT_EQ(read, values);
    EXPECT_EQ(in.left(), 0u);
  }
}

TEST(Archive, BytesThatEndTooEarlyAreAnError) {
  ByteWriter out;
  out(Padded{true, 2, Colour::blue, {"one", "two"}});
  for (std::size_t size = 0; size < out.bytes().size(); ++size) {
    const std::span<const std::byte> bytes = out.bytes();
    ByteReader in(bytes.first(size));
    Padded read;
    EXPECT_THROW(in(read), Error) << size;
  }
}

// A count that cannot be must not be allocated.
TEST(Archive, WrongCountsAreAnError) {
  ByteWriter out;
  out(std::uint64_t{1} << 62, std::uint64_t{1} << 62, 0.0);
  std::string text;
  std::vector<double> numbers;
  std::vector<Padded> structs;
  Eigen::MatrixXd matrix;
  EXPECT_THROW(reader(out.bytes())(text), Error);
  EXPECT_THROW(reader(out.bytes())(numbers), Error);
  EXPECT_THROW(reader(out.bytes())(structs), Error);
  EXPECT_THROW(reader(out.bytes())(matrix), Error);
  std::size_t n = 0;
  EXPECT_THROW(reader(out.bytes()).count(n, 1), Error);
}

TEST(Archive, ValuesThatATypeDoesNotHaveAreAnError) {
  const std::vector<std::byte> bytes(8, std::byte{3});
  bool flag = false;
  Colour colour = Colour::red;
  std::variant<int, double> either;
  std::optional<int> maybe;
  EXPECT_THROW(reader(bytes)(flag), Error);
  EXPECT_THROW(reader(bytes).choice(colour, Colour::blue), Error);
  EXPECT_THROW(reader(bytes)(either), Error);
  EXPECT_THROW(reader(bytes)(maybe), Error);
}

}  // namespace
}  // namespace poinsot
