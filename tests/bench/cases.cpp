#include "cases.h"

#include <cstdint>
#include <random>

namespace poinsot::bench {
namespace {

class Random {
 public:
  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }
  // Uniform over all orientations, by rejection.
  Quat rotation() {
    Eigen::Vector4d q;
    do {
      for (double& x : q) x = uniform(-1, 1);
    } while (q.squaredNorm() > 1 || q.squaredNorm() < 0.01);
    return Quat(q).normalized();
  }

 private:
  std::mt19937_64 bits_{20240229};
};

CaseBody turning(const Vec3& omega) {
  CaseBody body;
  body.omega = omega;
  return body;
}

Case crowd() {
  Case result{.name = "crowd", .duration = 10, .gravity = Vec3(0, 0, -9.81)};
  Random random;
  for (int i = 0; i < 1000; ++i) {
    CaseBody body;
    body.mass = random.uniform(1, 5);
    const Vec3 edge = Vec3(0.6, 0.6, 0.6) + random.in_cube(0.4);  // of a homogeneous box
    const Vec3 s = edge.cwiseAbs2();
    body.moments = body.mass / 12 * Vec3(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
    body.pose.c = random.in_cube(50);
    body.pose.q = random.rotation();
    body.velocity = random.in_cube(5);
    body.omega = random.in_cube(5);
    result.bodies.push_back(body);
  }
  return result;
}

std::vector<Case> make_cases() {
  Case racket{.name = "racket", .bodies = {turning(Vec3(1e-3, 5, 1e-3))}};
  Case tumble{.name = "tumble", .bodies = {turning(Vec3(1, 3, 2))}};
  Case pushed{.name = "pushed",
              .torque_W = Vec3(0.3, -0.2, 0.1),
              .force_B = Vec3(0.5, 0, 0.2),
              .bodies = {turning(Vec3(1, 3, 2))}};
  Case falling{.name = "falling", .duration = 10, .gravity = Vec3(0, 0, -9.81), .drag = 0.4};
  falling.bodies = {CaseBody{.velocity = Vec3(3, 0, 4)}};
  Case spring{.name = "spring", .duration = 10, .spring = CaseSpring{.stiffness = 40}};
  spring.bodies = {CaseBody{.pose = {Vec3(1, 0, 0), Quat::Identity()}, .velocity = Vec3(0, 2, 1)}};
  return {racket, tumble, crowd(), pushed, falling, spring};
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = make_cases();
  return all;
}

}  // namespace poinsot::bench
