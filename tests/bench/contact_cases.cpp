#include "contact_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>

#include "poinsot/scene/mass_properties.h"

namespace poinsot::bench {
namespace {

constexpr double kDensity = 1000;  // [kg/m³]
constexpr double kJitter = 0.02;   // [m]

class Random {
 public:
  double unit() {  // 0 … 1
    x_ = 1664525u * x_ + 1013904223u;
    return (x_ >> 8) / 16777216.0;
  }
  double within(double low, double high) { return low + (high - low) * unit(); }
  Vec3 jitter() {
    const double x = within(-kJitter, kJitter), y = within(-kJitter, kJitter);
    return {x, y, std::abs(within(-kJitter, kJitter))};
  }
  Vec3 direction() {
    const double z = within(-1, 1), angle = within(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  // Source: Shoemake, "Uniform random rotations" (Graphics Gems III, 1992).
  Quat rotation() {
    const double u = unit(), a = within(0, 2 * std::numbers::pi),
                 b = within(0, 2 * std::numbers::pi);
    const double s = std::sqrt(1 - u), r = std::sqrt(u);
    return {r * std::cos(b), s * std::sin(a), s * std::cos(a), r * std::sin(b)};
  }

 private:
  std::uint32_t x_ = 12345;
};

ContactBody body(const Shape& shape, const Vec3& c, double mass = 0) {
  const MassProperties dense = mass_properties(shape, kDensity);
  const double m = mass > 0 ? mass : dense.mass;
  return {shape, m, dense.J.diagonal() * (m / dense.mass), {c, Quat::Identity()}, Vec3::Zero()};
}

ContactBody unit_box(const Vec3& c, double mass = 0) {
  return body(Box{{1, 1, 1}}, c, mass);
}

// The hull of points about a sphere, moved to its centre of mass and turned to its principal axes.
ContactBody random_hull(Random& random, const Vec3& c) {
  constexpr double kRadius = 0.6;  // [m]
  std::vector<Vec3> points(8 + static_cast<std::size_t>(random.unit() * 7));
  for (Vec3& point : points) point = kRadius * random.direction();
  const MassProperties m = mass_properties(convex_hull(points), kDensity);
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(m.J);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  for (Vec3& point : points) point = axes.transpose() * (point - m.center_of_mass);
  return {convex_hull(points), m.mass, solver.eigenvalues(), {c, Quat::Identity()}, Vec3::Zero()};
}

ContactScene tower(const std::vector<double>& masses) {
  ContactScene scene;
  for (const double mass : masses)
    scene.bodies.push_back(unit_box({0, 0, 0.5 + static_cast<double>(scene.bodies.size())}, mass));
  return scene;
}

std::vector<double> alternating(double heavy) {
  std::vector<double> masses;
  for (int k = 0; k < 30; ++k) masses.push_back(k % 2 == 0 ? 1 : heavy);
  return masses;
}

// Friction on a body that slides and whose front carries more than its rear turns it about: of a
// cube, small errors of its direction grow by e every 0.4 s, of this slab every 0.9 s.
constexpr double kSlabHeight = 0.2;  // [m]

// A box of 1 m × 1 m on a slope whose way down looks along every azimuth, aligned with that way.
std::vector<ContactScene> inclines(double angle, int azimuths, double height) {
  std::vector<ContactScene> scenes;
  for (int k = 0; k < azimuths; ++k) {
    ContactScene scene;
    scene.ground = Quat(Eigen::AngleAxisd(2 * std::numbers::pi * k / azimuths, Vec3::UnitZ()) *
                        Eigen::AngleAxisd(angle, Vec3::UnitY()));
    scene.bodies.push_back(body(Box{{1, 1, height}}, scene.ground * Vec3(0, 0, 0.5 * height)));
    scene.bodies.back().pose.q = scene.ground;
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

ContactScene moving(const Shape& shape, double height, double speed, double friction) {
  ContactScene scene;
  scene.friction = friction;
  scene.bodies.push_back(body(shape, {0, 0, height}));
  scene.bodies.back().velocity.x() = speed;
  return scene;
}

using Place = std::function<ContactBody(Random&, const Vec3&)>;

// Bodies nx × ny × nz, `pitch` apart, the lowest centres at `bottom`; x runs fastest.
ContactScene lattice(int nx, int ny, int nz, const Vec3& pitch, double bottom, const Place& place) {
  ContactScene scene;
  Random random;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const Vec3 node((i - 0.5 * (nx - 1)) * pitch.x(), (j - 0.5 * (ny - 1)) * pitch.y(),
                        bottom + k * pitch.z());
        const Vec3 c = node + random.jitter();
        scene.bodies.push_back(place(random, c));
      }
  return scene;
}

ContactBody aligned_box(Random&, const Vec3& c) {
  return unit_box(c);
}

ContactBody turned_box(Random& random, const Vec3& c) {
  ContactBody box = unit_box(c);
  box.pose.q = random.rotation();
  return box;
}

ContactScene boxes(int nx, int ny, int nz, double gap) {
  return lattice(nx, ny, nz, Vec3::Constant(1 + gap), 0.5 + gap, aligned_box);
}

ContactScene heap() {
  return lattice(10, 10, 10, Vec3::Constant(1.8), 0.9, turned_box);
}

ContactScene pit() {
  constexpr double kWidth = 6, kHeight = 16, kThickness = 1, kRadius = 0.25;  // [m]
  ContactScene scene = lattice(10, 10, 20, Vec3::Constant(0.56), 0.3,
                               [](Random&, const Vec3& c) { return body(Sphere{kRadius}, c); });
  const double length = kWidth + 2 * kThickness, offset = 0.5 * (kWidth + kThickness);
  for (const double side : {-1.0, 1.0}) {
    scene.walls.push_back({Box{{kThickness, length, kHeight}},
                           0,
                           Vec3::Zero(),
                           {Vec3(side * offset, 0, 0.5 * kHeight), Quat::Identity()}});
    scene.walls.push_back({Box{{kWidth, kThickness, kHeight}},
                           0,
                           Vec3::Zero(),
                           {Vec3(0, side * offset, 0.5 * kHeight), Quat::Identity()}});
  }
  return scene;
}

ContactScene wall() {
  constexpr int kRows = 40;
  ContactScene scene;
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kRows - row; ++i)
      scene.bodies.push_back(unit_box({i - 0.5 * (kRows - row - 1), 0, 0.5 + row}));
  return scene;
}

ContactScene towers() {
  ContactScene scene;
  for (int n = 0; n < 50; ++n)
    for (int k = 0; k < 10; ++k)
      scene.bodies.push_back(unit_box({3.0 * (n % 10), 3.0 * (n / 10), 0.5 + k}));
  return scene;
}

ContactScene mixed() {
  int n = 0;
  return lattice(10, 10, 10, Vec3::Constant(1.8), 0.9, [&n](Random& random, const Vec3& c) {
    ContactBody one = n++ % 2 == 0 ? body(Capsule{0.25, 0.5}, c) : random_hull(random, c);
    one.pose.q = random.rotation();
    return one;
  });
}

struct Row {
  const char* name;
  Question question;
  double duration;  // [s]
  std::vector<ContactScene> (*make)();
};

using Scenes = std::vector<ContactScene>;

const std::array<Row, 17> kRows = {{
    {"tower10", Question::stands, 60, [] { return Scenes{tower(std::vector<double>(10, 1000))}; }},
    {"heavy_top", Question::stands, 10,
     [] {
       return Scenes{tower({1, 10, 100, 1000})};
     }},
    {"alternating30", Question::stands, 10, [] { return Scenes{tower(alternating(1e3))}; }},
    {"alternating30_1e4", Question::stands, 10, [] { return Scenes{tower(alternating(1e4))}; }},
    {"incline_stick", Question::sticks, 10, [] { return inclines(kStickAngle, 8, 1); }},
    {"incline_slide", Question::slides, 2, [] { return inclines(kSlopeAngle, 24, kSlabHeight); }},
    {"sliding_stop", Question::stops, 3,
     [] {
       return Scenes{moving(Box{{1, 1, 1}}, 0.5, kStopSpeed, kStopFriction)};
     }},
    {"slip_to_roll", Question::rolls, 2,
     [] { return Scenes{moving(Sphere{0.5}, 0.5, kRollSpeed, kRollFriction)}; }},
    {"grid1000", Question::piles, 10, [] { return Scenes{boxes(10, 10, 10, 0.1)}; }},
    {"heap1000", Question::piles, 10, [] { return Scenes{heap()}; }},
    {"pit2000", Question::piles, 10, [] { return Scenes{pit()}; }},
    {"boxes5000", Question::piles, 10, [] { return Scenes{boxes(25, 25, 8, 1)}; }},
    {"wall820", Question::piles, 10, [] { return Scenes{wall()}; }},
    {"towers50", Question::piles, 10, [] { return Scenes{towers()}; }},
    {"mixed1000", Question::piles, 10, [] { return Scenes{mixed()}; }},
    {"boxes100", Question::piles, 10, [] { return Scenes{boxes(5, 5, 4, 0.1)}; }},
    {"boxes10000", Question::piles, 10, [] { return Scenes{boxes(20, 20, 25, 0.1)}; }},
}};

}  // namespace

std::vector<std::string> contact_case_names() {
  std::vector<std::string> names;
  for (const Row& row : kRows) names.emplace_back(row.name);
  return names;
}

ContactCase contact_case(const std::string& name) {
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.name == name; });
  if (row == kRows.end()) throw std::runtime_error("no such case: " + name);
  return {row->name, row->question, row->duration, row->make()};
}

}  // namespace poinsot::bench
