#include "poinsot/presentation/value_check.h"

#include <cstdio>

namespace poinsot {

std::string text(const Vec3& v) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%g, %g, %g)", v.x(), v.y(), v.z());
  return buffer;
}

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", x);
  return buffer;
}

std::optional<Refusal> check_vector(std::string_view what, const Vec3& v, std::string_view unit,
                                    double limit) {
  const std::string received =
      std::string(what) + " is " + text(v) + " " + std::string(unit) + ": ";
  if (!v.allFinite()) return invalid(received + "every component must be finite");
  if (v.cwiseAbs().maxCoeff() > limit)
    return invalid(received + "no component may exceed " + text(limit));
  return std::nullopt;
}

std::optional<Refusal> check_coefficient(std::string_view what, double x, std::string_view unit,
                                         double limit) {
  if (x >= 0 && x <= limit) return std::nullopt;
  return invalid(std::string(what) + " is " + text(x) + " " + std::string(unit) +
                 ": it must be 0 to " + text(limit));
}

}  // namespace poinsot
