// Archive: values as bytes and back, for checkpoints. Not a format for exchange: the bytes are
// those of this program on this machine; who keeps them stores which program wrote them, and a
// checksum.
//
//   struct Memory {
//     double h = 0;
//     std::vector<int> steps;
//     template <class Archive> void archive(Archive& with) { with(h, steps); }
//   };
//   ByteWriter out;  out(memory);
//   ByteReader in(out.bytes());  in(memory);   // throws Error where the bytes end too early
//
// Known are numbers, Eigen's matrices and quaternions, strings, arrays, vectors, optionals and
// variants of these, types with a member archive(with), and types with a function archive(with,
// value) in their namespace. Structs are taken apart member by member, so that equal values give
// equal bytes: padding is not among them. Enumerations go through choice(), which knows the last of
// them.
//
// Damaged bytes make a reader throw, or give other values; never values that their type does not
// have, nor more memory than some multiple of the bytes. What is an index or a count to somebody is
// checked by who reads it.

#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "poinsot/base/error.h"

namespace poinsot {

namespace archive_detail {

template <class T, class Archive>
concept HasMember = requires(T& value, Archive& with) {
  value.archive(with);
};
template <class T, class Archive>
concept HasFunction = requires(T& value, Archive& with) {
  archive(with, value);
};
template <class T>
concept IsMatrix = std::derived_from<T, Eigen::PlainObjectBase<T>>;
template <class T>
concept IsNumber = std::is_arithmetic_v<T>;

template <IsMatrix T>
inline constexpr bool kIsFixed = T::SizeAtCompileTime != Eigen::Dynamic;

}  // namespace archive_detail

class ByteWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  void raw(const void* data, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  // How many of something follow, of at least `least` bytes each.
  void count(std::size_t& n, std::size_t /*least*/) { add(static_cast<std::uint64_t>(n)); }
  // An enumeration from 0 to `last`.
  template <class E>
  void choice(const E& value, E /*last*/) {
    add(static_cast<std::uint8_t>(value));
  }
  // A vector whose size the reader knows.
  template <class T>
  void fixed(const std::vector<T>& values) {
    add_all(values);
  }
  // The same of which only the elements with keep(k) are written; the reader's others become T{}.
  template <class T, class Keep>
  void some(const std::vector<T>& values, const Keep& keep) {
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (keep(k)) bits = static_cast<std::uint8_t>(bits | 1u << k % 8);
      if (k % 8 != 7 && k + 1 != values.size()) continue;
      add(bits);
      bits = 0;
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      if (keep(k)) add(values[k]);
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }
  void clear() { bytes_.clear(); }  // keeps the memory

 private:
  template <class T>
  void add(const T& value) {
    using namespace archive_detail;
    if constexpr (HasMember<T, ByteWriter>) {
      const_cast<T&>(value).archive(*this);  // a writer changes nothing
    } else if constexpr (HasFunction<T, ByteWriter>) {
      archive(*this, const_cast<T&>(value));
    } else if constexpr (IsMatrix<T>) {
      if constexpr (!kIsFixed<T>) {
        add(static_cast<std::uint64_t>(value.rows()));
        add(static_cast<std::uint64_t>(value.cols()));
      }
      raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else {
      static_assert(IsNumber<T>, "no archive() for this type");
      raw(&value, sizeof value);
    }
  }
  void add(const Eigen::Quaterniond& q) { add(q.coeffs()); }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    raw(text.data(), text.size());
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    add_all(values);
  }
  template <class T, std::size_t n>
  void add(const std::array<T, n>& values) {
    add_all(values);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class... Ts>
  void add(const std::variant<Ts...>& value) {
    add(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& alternative) { add(alternative); }, value);
  }
  template <class Values>
  void add_all(const Values& values) {
    using T = typename Values::value_type;
    if constexpr (archive_detail::IsNumber<T>) {
      raw(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) add(value);
    }
  }

  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
  static constexpr bool kReads = true;

  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  void raw(void* data, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  void count(std::size_t& n, std::size_t least) {
    std::uint64_t read = 0;
    get(read);
    if (read > bytes_.size() / (least > 0 ? least : 1)) fail();
    n = read;
  }
  template <class E>
  void choice(E& value, E last) {
    std::uint8_t read = 0;
    get(read);
    if (read > static_cast<std::uint8_t>(last)) fail();
    value = static_cast<E>(read);
  }
  template <class T>
  void fixed(std::vector<T>& values) {
    get_all(values);
  }
  template <class T, class Keep>
  void some(std::vector<T>& values, const Keep& /*keep*/) {
    const std::size_t groups = (values.size() + 7) / 8;
    if (groups > bytes_.size()) fail();
    const std::span<const std::byte> flags = bytes_.first(groups);
    bytes_ = bytes_.subspan(groups);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = T{};
      if ((std::to_integer<unsigned>(flags[k / 8]) >> k % 8 & 1u) != 0) get(values[k]);
    }
  }

  std::size_t left() const { return bytes_.size(); }
  [[noreturn]] static void fail() { throw Error("checkpoint: the bytes are damaged"); }

 private:
  template <class T>
  void get(T& value) {
    using namespace archive_detail;
    if constexpr (HasMember<T, ByteReader>) {
      value.archive(*this);
    } else if constexpr (HasFunction<T, ByteReader>) {
      archive(*this, value);
    } else if constexpr (IsMatrix<T>) {
      if constexpr (!kIsFixed<T>) resize(value);
      raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else {
      static_assert(IsNumber<T>, "no archive() for this type");
      raw(&value, sizeof value);
    }
  }
  void get(bool& value) {
    std::uint8_t read = 0;
    get(read);
    if (read > 1) fail();
    value = read != 0;
  }
  void get(Eigen::Quaterniond& q) { get(q.coeffs()); }
  void get(std::string& text) {
    std::size_t n = 0;
    count(n, 1);
    text.resize(n);
    raw(text.data(), n);
  }
  void get(std::vector<bool>&) = delete;
  template <class T>
  void get(std::vector<T>& values) {
    std::size_t n = 0;
    values.clear();
    if constexpr (archive_detail::IsNumber<T>) {
      count(n, sizeof(T));
      values.resize(n);
      get_all(values);
    } else {  // grows as elements come: a wrong count ends with the bytes
      count(n, 1);
      for (std::size_t k = 0; k < n; ++k) get(values.emplace_back());
    }
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& values) {
    get_all(values);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool has = false;
    get(has);
    value.reset();
    if (has) get(value.emplace());
  }
  template <class... Ts>
  void get(std::variant<Ts...>& value) {
    std::uint8_t index = 0;
    get(index);
    if (index >= sizeof...(Ts)) fail();
    std::uint8_t k = 0;
    ((k++ == index ? get(value.template emplace<Ts>()) : void()), ...);
  }
  template <class Values>
  void get_all(Values& values) {
    using T = typename Values::value_type;
    if constexpr (archive_detail::IsNumber<T> && !std::is_same_v<T, bool>) {
      raw(values.data(), values.size() * sizeof(T));
    } else {
      for (T& value : values) get(value);
    }
  }
  template <class T>
  void resize(T& value) {
    std::uint64_t rows = 0, cols = 0;
    get(rows);
    get(cols);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 31;
    if (rows > kMost || cols > kMost || rows * cols > bytes_.size() / sizeof(typename T::Scalar))
      fail();
    const auto r = static_cast<Eigen::Index>(rows), c = static_cast<Eigen::Index>(cols);
    if ((T::RowsAtCompileTime != Eigen::Dynamic && r != T::RowsAtCompileTime) ||
        (T::ColsAtCompileTime != Eigen::Dynamic && c != T::ColsAtCompileTime))
      fail();
    value.resize(r, c);
  }

  std::span<const std::byte> bytes_;
};

}  // namespace poinsot
