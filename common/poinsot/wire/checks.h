// Checks of received values. A Checks collects the first fault of one message; later ones are not
// looked at. Private to this module.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "poinsot/base/body_id.h"
#include "poinsot/math/types.h"
#include "poinsot/msg/types.h"

namespace poinsot {

// How far |q|² may be from 1: room for senders in single precision, none for mistakes.
inline constexpr double kUnitSlack = 1e-5;

class Checks {
 public:
  bool ok() const { return reason_.empty(); }
  std::string take() { return std::move(reason_); }

  void require(bool condition, std::string_view reason) {
    if (!condition && ok()) reason_ = reason;
  }
  // Finite, and not beyond ±limit.
  void number(double value, std::string_view name, double limit = HUGE_VAL);
  void vector(const Vec3& value, std::string_view name, double limit = HUGE_VAL);
  void unit(const Quat& value, std::string_view name);
  // Printable UTF-8, at most `limit` bytes.
  void text(std::string_view value, std::string_view name, std::size_t limit);
  // The same in lines.
  void lines(std::string_view value, std::string_view name, std::size_t limit);

 private:
  std::string reason_;
};

// Six digits, for a reason.
std::string number_text(double value);

inline Vec3 from(const msg::v1::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Quat from(const msg::v1::Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
inline void assign(msg::v1::Vector3& out, const Vec3& v) {
  out.x(v.x());
  out.y(v.y());
  out.z(v.z());
}
inline void assign(msg::v1::Quaternion& out, const Quat& q) {
  out.x(q.x());
  out.y(q.y());
  out.z(q.z());
  out.w(q.w());
}

inline BodyId from(const msg::v1::BodyHandle& handle) {
  return {handle.slot(), handle.generation()};
}
inline void assign(msg::v1::BodyHandle& out, BodyId id) {
  out.slot(id.slot);
  out.generation(id.generation);
}

// A generated enumeration to ours, which counts from 0 without holes up to `last`.
template <class Ours, class Theirs>
Ours known(Checks& checks, Theirs value, Ours last, std::string_view name) {
  const auto number = static_cast<std::uint32_t>(value);
  if (number <= static_cast<std::uint32_t>(last)) return static_cast<Ours>(number);
  checks.require(false, std::string(name) + " " + std::to_string(number) + " is unknown");
  return Ours{};
}

}  // namespace poinsot
