#include "poinsot/scene/mesh_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/scene/mesh.h"

namespace poinsot {
namespace {

constexpr std::size_t kMaxQuote = 40;  // [bytes] of a word repeated in a message

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

Mesh finish(const Soup& soup, const std::string& name) {
  try {
    return make_mesh(soup.vertices, soup.triangles);
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

// Text, word by word ------------------------------------------------------------------------------

class Words {
 public:
  Words(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  // To the next line that has a word; a '#' ends a line. False at the end of the text.
  bool next_line() {
    while (!rest_.empty()) {
      ++number_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      line_ = line_.substr(0, line_.find('#'));
      skip_spaces();
      if (!line_.empty()) return true;
    }
    return false;
  }

  // Empty at the end of the line.
  std::string_view word() {
    const std::string_view found = line_.substr(0, line_.find_first_of(" \t\r\f\v"));
    line_.remove_prefix(found.size());
    skip_spaces();
    return found;
  }
  bool at_end_of_line() const { return line_.empty(); }

  double number() {
    const std::string_view text = word();
    std::string_view digits = text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value))
      fail("a coordinate must be a finite decimal number, is " + quoted(text));
    return value;
  }
  Vec3 vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(name_ + ":" + std::to_string(number_) + ": " + what);
  }
  static std::string quoted(std::string_view text) {
    return std::string("'").append(text.substr(0, kMaxQuote)).append("'");
  }

 private:
  void skip_spaces() {
    const std::size_t first = line_.find_first_not_of(" \t\r\f\v");
    line_.remove_prefix(std::min(first, line_.size()));
  }

  std::string_view rest_, line_;
  const std::string& name_;
  int number_ = 0;
};

// OBJ ---------------------------------------------------------------------------------------------

// "7", "7/1", "7/1/2", "7//2" or with a negative number, counted back from the last vertex.
int read_corner(Words& words, std::string_view word, std::size_t vertices) {
  const std::string_view first = word.substr(0, word.find('/'));
  long long index = 0;
  const auto [stop, error] = std::from_chars(first.data(), first.data() + first.size(), index);
  if (error != std::errc() || stop != first.data() + first.size())
    words.fail("a corner of a face must be the number of a vertex, is " + Words::quoted(word));
  const auto count = static_cast<long long>(vertices);
  const long long from_0 = index < 0 ? count + index : index - 1;
  if (from_0 < 0 || from_0 >= count)
    words.fail("a face names vertex " + std::to_string(index) + " of " + std::to_string(vertices));
  return static_cast<int>(from_0);
}

// Whether the fan about the first corner lies within the polygon: no triangle of it is turned over.
bool is_fan(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return vertices[static_cast<std::size_t>(loop[k])];
  };
  std::vector<Vec3> areas;
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 2; k < loop.size(); ++k) {
    areas.push_back((at(k - 1) - at(0)).cross(at(k) - at(0)));
    sum += areas.back();
  }
  return std::ranges::all_of(areas, [&](const Vec3& area) { return area.dot(sum) >= 0; });
}

void read_face(Words& words, Soup& soup, std::vector<int>& loop) {
  loop.clear();
  while (!words.at_end_of_line())
    loop.push_back(read_corner(words, words.word(), soup.vertices.size()));
  if (loop.size() < 3) words.fail("a face needs three corners");
  if (loop.size() > 3 && !is_fan(soup.vertices, loop))
    words.fail("a face of more than three corners must be convex");
  for (std::size_t k = 2; k < loop.size(); ++k)
    soup.triangles.push_back({loop[0], loop[k - 1], loop[k]});
}

// STL ---------------------------------------------------------------------------------------------

constexpr std::size_t kStlHead = 84, kStlTriangle = 50;  // [bytes]

template <class Value>
Value little_endian(const char* bytes) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 4; ++k)
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) << (8 * k);
  Value value;
  static_assert(sizeof value == sizeof bits);
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// A binary file has exactly the length that its number of triangles asks for.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < kStlHead) return false;
  const std::uint64_t count = little_endian<std::uint32_t>(bytes.data() + kStlHead - 4);
  return bytes.size() == kStlHead + count * kStlTriangle;
}

void add_triangle(Soup& soup, const std::array<Vec3, 3>& corners) {
  const auto first = static_cast<int>(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
  soup.triangles.push_back({first, first + 1, first + 2});
}

Soup read_binary_stl(std::string_view bytes) {
  Soup soup;
  for (std::size_t at = kStlHead; at < bytes.size(); at += kStlTriangle) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)  // after the normal
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<double>(little_endian<float>(bytes.data() + at + 12 + 4 * k));
    add_triangle(soup, corners);
  }
  return soup;
}

// facet normal … / outer loop / vertex x y z, three times / endloop / endfacet
Soup read_ascii_stl(std::string_view text, const std::string& name) {
  Soup soup;
  Words words(text, name);
  if (!words.next_line() || words.word() != "solid")
    throw Error(name +
                ": neither an ASCII STL file, which begins with 'solid', nor a binary one, "
                "whose length follows from its number of triangles");
  std::array<Vec3, 3> corners;
  std::size_t count = 0;
  while (words.next_line()) {
    const std::string_view word = words.word();
    if (word == "vertex") {
      if (count == 3) words.fail("a facet has three vertices");
      corners[count++] = words.vector();
    } else if (word == "endfacet") {
      if (count != 3) words.fail("a facet has three vertices, this one " + std::to_string(count));
      add_triangle(soup, corners);
      count = 0;
    } else if (word != "facet" && word != "outer" && word != "endloop" && word != "endsolid" &&
               word != "solid") {
      words.fail("unknown word " + Words::quoted(word) + " in an STL file");
    }
  }
  if (count != 0) words.fail("the last facet has no end");
  return soup;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(file.string() + ": cannot be read: it is no regular file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw Error(file.string() + ": cannot be read: " + error.message());
  if (size > kMaxMeshFile)
    throw Error(file.string() + ": a mesh file must not be longer than " +
                std::to_string(kMaxMeshFile) + " bytes");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    throw Error(file.string() + ": cannot be read: " + std::strerror(errno ? errno : EIO));
  return bytes;
}

}  // namespace

Mesh read_obj(std::string_view text, const std::string& name) {
  Soup soup;
  Words words(text, name);
  std::vector<int> loop;
  constexpr std::string_view kPassedOver[] = {"vt",     "vn",     "vp",     "g",   "o",
                                              "s",      "usemtl", "mtllib", "p",   "l",
                                              "cstype", "deg",    "curv",   "end", "parm"};
  while (words.next_line()) {
    const std::string_view word = words.word();
    if (word == "v")
      soup.vertices.push_back(words.vector());
    else if (word == "f")
      read_face(words, soup, loop);
    else if (std::ranges::find(kPassedOver, word) == std::end(kPassedOver))
      words.fail("unknown word " + Words::quoted(word) + " in an OBJ file");
  }
  return finish(soup, name);
}

Mesh read_stl(std::string_view bytes, const std::string& name) {
  return finish(is_binary_stl(bytes) ? read_binary_stl(bytes) : read_ascii_stl(bytes, name), name);
}

Mesh read_mesh_file(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (extension == ".obj") return read_obj(read_bytes(file), file.string());
  if (extension == ".stl") return read_stl(read_bytes(file), file.string());
  throw Error(file.string() + ": a mesh file must end in .obj or .stl");
}

}  // namespace poinsot
