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
// Known are plain structs without pointers, enumerations and numbers, Eigen matrices, quaternions,
// strings, vectors, optionals and variants of these, and types with archive().

#pragma once

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
concept HasArchive = requires(T& value, Archive& with) {
  value.archive(with);
};
template <class T>
concept IsMatrix = std::derived_from<T, Eigen::PlainObjectBase<T>>;
template <class T>
concept IsPlain =
    std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_member_pointer_v<T>;

}  // namespace archive_detail

class ByteWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  void raw(const void* data, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }
  void clear() { bytes_.clear(); }  // keeps the memory

 private:
  template <class T>
  void add(const T& value) {
    if constexpr (archive_detail::HasArchive<T, ByteWriter>) {
      const_cast<T&>(value).archive(*this);  // a writer changes nothing
    } else if constexpr (archive_detail::IsMatrix<T>) {
      add(static_cast<std::uint64_t>(value.rows()));
      add(static_cast<std::uint64_t>(value.cols()));
      raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else {
      static_assert(archive_detail::IsPlain<T>, "no archive() for this type");
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
    if constexpr (archive_detail::IsPlain<T> && !archive_detail::HasArchive<T, ByteWriter> &&
                  !archive_detail::IsMatrix<T>)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values) add(value);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class... Ts>
  void add(const std::variant<Ts...>& value) {
    add(static_cast<std::uint64_t>(value.index()));
    std::visit([this](const auto& alternative) { add(alternative); }, value);
  }

  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
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

  std::size_t left() const { return bytes_.size(); }
  [[noreturn]] static void fail() { throw Error("checkpoint: the bytes are damaged"); }

 private:
  // A count of elements of at least `size` bytes each: no more than there can be.
  std::uint64_t count(std::size_t size) {
    std::uint64_t n = 0;
    get(n);
    if (n > bytes_.size() / (size > 0 ? size : 1)) fail();
    return n;
  }

  template <class T>
  void get(T& value) {
    if constexpr (archive_detail::HasArchive<T, ByteReader>) {
      value.archive(*this);
    } else if constexpr (archive_detail::IsMatrix<T>) {
      std::uint64_t rows = 0, cols = 0;
      get(rows);
      get(cols);
      constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
      if (rows > kMost || cols > kMost || rows * cols > bytes_.size() / sizeof(typename T::Scalar))
        fail();
      const auto r = static_cast<Eigen::Index>(rows), c = static_cast<Eigen::Index>(cols);
      if ((T::RowsAtCompileTime >= 0 && r != T::RowsAtCompileTime) ||
          (T::ColsAtCompileTime >= 0 && c != T::ColsAtCompileTime))
        fail();
      value.resize(r, c);
      raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else {
      static_assert(archive_detail::IsPlain<T>, "no archive() for this type");
      raw(&value, sizeof value);
    }
  }
  void get(Eigen::Quaterniond& q) { get(q.coeffs()); }
  void get(std::string& text) {
    text.resize(count(1));
    raw(text.data(), text.size());
  }
  void get(std::vector<bool>&) = delete;
  template <class T>
  void get(std::vector<T>& values) {
    if constexpr (archive_detail::IsPlain<T> && !archive_detail::HasArchive<T, ByteReader> &&
                  !archive_detail::IsMatrix<T>) {
      values.resize(count(sizeof(T)));
      raw(values.data(), values.size() * sizeof(T));
    } else {
      const std::uint64_t n = count(1);
      values.clear();
      values.resize(n);
      for (T& value : values) get(value);
    }
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
    std::uint64_t index = 0;
    get(index);
    if (index >= sizeof...(Ts)) fail();
    std::size_t k = 0;
    ((k++ == index ? get(value.template emplace<Ts>()) : void()), ...);
  }

  std::span<const std::byte> bytes_;
};

}  // namespace poinsot
