#include "poinsot/scene/mass_properties.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/math/inertia.h"

namespace poinsot {
namespace {

constexpr double kPi = std::numbers::pi;
// Some tens of operations on numbers of one scale: rounding, relative to that scale.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

void expect_same(const MassProperties& a, const MassProperties& b, double size, double slack) {
  EXPECT_NEAR(a.mass, b.mass, slack * b.mass);
  EXPECT_NEAR((a.center_of_mass - b.center_of_mass).norm(), 0, slack * size);
  EXPECT_NEAR((a.J - b.J).norm(), 0, slack * b.mass * size * size);
}

// Quadrature by slices --------------------------------------------------------------------------
// A solid of revolution with radius r(z): dV = π r² dz, and a disc's ∫ x² = ∫ y² = π r⁴/4. Gauss's
// five points are exact for polynomials up to degree nine: all profiles here, piece by piece.

struct Piece {
  double from, to;
  std::function<double(double)> radius_squared;
};

MassProperties by_slices(const std::vector<Piece>& pieces, double density) {
  constexpr std::array<double, 5> nodes = {-0.90617984593866399280, -0.53846931010568309104, 0,
                                           0.53846931010568309104, 0.90617984593866399280};
  constexpr std::array<double, 5> weights = {0.23692688505618908751, 0.47862867049936646804,
                                             0.56888888888888888889, 0.47862867049936646804,
                                             0.23692688505618908751};
  double volume = 0, first = 0, along = 0, across = 0;  // ∫ 1, ∫ z, ∫ z², ∫ x²
  for (const Piece& piece : pieces) {
    const double half = (piece.to - piece.from) / 2, middle = (piece.to + piece.from) / 2;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double z = middle + half * nodes[i];
      const double r2 = piece.radius_squared(z), dz = half * weights[i];
      volume += kPi * r2 * dz;
      first += kPi * r2 * z * dz;
      along += kPi * r2 * z * z * dz;
      across += kPi * r2 * r2 / 4 * dz;
    }
  }
  const double c = first / volume;
  const double zz = along - volume * c * c;
  const Vec3 moments(across + zz, across + zz, 2 * across);
  return {density * volume, Vec3(0, 0, c), density * Mat3(moments.asDiagonal())};
}

TEST(MassProperties, OfRoundSolidsAreTheirIntegralsBySlices) {
  const double r = 0.7, l = 1.9, rho = 830;
  const auto ball = [r](double z) { return r * r - z * z; };
  const auto rod = [r](double) { return r * r; };
  expect_same(mass_properties(Sphere{r}, rho), by_slices({{-r, r, ball}}, rho), r, kRounding);
  expect_same(mass_properties(Cylinder{r, l}, rho), by_slices({{-l / 2, l / 2, rod}}, rho), l,
              kRounding);
  expect_same(mass_properties(Capsule{r, l}, rho),
              by_slices({{-l / 2 - r, -l / 2, [&](double z) { return ball(z + l / 2); }},
                         {-l / 2, l / 2, rod},
                         {l / 2, l / 2 + r, [&](double z) { return ball(z - l / 2); }}},
                        rho),
              l, kRounding);
  const auto point = [r, l](double z) { return r * r * (0.5 - z / l) * (0.5 - z / l); };
  const MassProperties cone = mass_properties(Cone{r, l}, rho);
  expect_same(cone, by_slices({{-l / 2, l / 2, point}}, rho), l, kRounding);
  EXPECT_DOUBLE_EQ(cone.center_of_mass.z(), -l / 4);
}

TEST(MassProperties, OfAnEllipsoidAreThoseOfAStretchedBall) {
  // x → a x: ∫ x² dV scales with a³bc, so m ⟨x²⟩ of the unit ball, 1/5, becomes a²/5.
  const Vec3 axes(0.5, 1.25, 2);
  const MassProperties m = mass_properties(Ellipsoid{axes}, 3);
  EXPECT_DOUBLE_EQ(m.mass, 3 * 4 * kPi / 3 * 0.5 * 1.25 * 2);
  for (int i = 0; i < 3; ++i) {
    const double second = m.J.trace() / 2 - m.J(i, i);  // m ⟨xᵢ²⟩
    EXPECT_NEAR(second, m.mass * axes[i] * axes[i] / 5, kRounding * m.mass * 4);
  }
  const MassProperties ball = mass_properties(Ellipsoid{Vec3(2, 2, 2)}, 5);
  expect_same(ball, mass_properties(Sphere{2}, 5), 2, kRounding);
}

// Quadrature by particles that carry the exact second moments ------------------------------------

TEST(MassProperties, OfABoxAreThoseOfEightParticlesAtGaussPoints) {
  const Vec3 size(0.4, 1.1, 2.3);
  const double density = 1000, m = density * size.prod();
  std::vector<Particle> particles;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    particles.push_back({m / 8, sign.cwiseProduct(size) / (2 * std::sqrt(3.0))});
  }
  expect_same(mass_properties(Box{size}, density), mass_properties(particles), 2.3, kRounding);
}

TEST(MassProperties, OfATetrahedronAreThoseOfFourParticlesAtItsQuadraturePoints) {
  const std::array<Vec3, 4> corners = {Vec3(3, 1, 0), Vec3(3.5, 1.2, 0.1), Vec3(3.1, 2, 0.3),
                                       Vec3(2.8, 1.1, 1.5)};
  Mat3 edges;
  edges << corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0];
  const double density = 7, m = density * std::abs(edges.determinant()) / 6;
  const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;
  std::vector<Particle> particles;  // exact for polynomials of degree two
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) point += (i == j ? near : far) * corners[j];
    particles.push_back({m / 4, point});
  }
  expect_same(mass_properties(convex_hull(corners), density), mass_properties(particles), 3.5,
              kRounding);
}

TEST(MassProperties, OfAPrismAreThoseOfTheRegularPolygon) {
  const int n = 7;
  const double radius = 0.9, length = 2.2, density = 12;
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (double z : {-length / 2, length / 2})
      points.emplace_back(radius * std::cos(2 * kPi * i / n), radius * std::sin(2 * kPi * i / n),
                          z);
  const double m = density * n / 2 * radius * radius * std::sin(2 * kPi / n) * length;
  const double half_turn = std::sin(kPi / n);
  const double along = m * radius * radius / 2 * (1 - 2.0 / 3 * half_turn * half_turn);
  const double across = along / 2 + m * length * length / 12;
  expect_same(mass_properties(convex_hull(points), density),
              {m, Vec3::Zero(), Mat3(Vec3(across, across, along).asDiagonal())}, length, kRounding);
}

TEST(MassProperties, OfAHullFarFromItsOriginLoseNoDigits) {
  const Vec3 far(1e4, -2e4, 3e4);
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(far + Vec3(i & 1, (i & 2) / 2, (i & 4) / 4));
  const MassProperties m = mass_properties(convex_hull(points), 1);
  expect_same(m, {1, far + Vec3(0.5, 0.5, 0.5), Mat3::Identity() / 6}, 1,
              4e4 * std::numeric_limits<double>::epsilon());  // half an ulp of the coordinates
}

// Brute force: the solid as the particles of a grid, with no formula but the shape's inequality.
// The solid is turned against the grid, so that each cell cut by the surface is wrong by its mass
// at most and the errors of n cells add up like √n (taken sixfold), not like n.

using Inside = std::function<bool(const Vec3&)>;

void expect_like_grid(const Shape& shape, const Inside& inside) {
  const int n = 32;
  const double radius = bounding_radius(shape), h = 2 * radius / n, density = 2;
  const double mass = density * h * h * h;
  const Pose pose{Vec3(0.3, -0.2, 0.1) * h, Quat(0.8, 0.25, -0.4, 0.3).normalized()};
  const Pose inverse = pose.inverse();
  std::vector<Particle> particles;
  int cut = 0;  // pairs of neighbours along x with the surface between them
  for (int j = -1; j <= n; ++j)
    for (int k = -1; k <= n; ++k) {
      bool before = false;
      for (int i = -1; i <= n; ++i) {
        const Vec3 middle = h * (Vec3(i, j, k) + Vec3::Constant(0.5)) - Vec3::Constant(radius);
        const bool now = inside(inverse * middle);
        if (now) particles.push_back({mass, middle});
        cut += now != before;
        before = now;
      }
    }
  // A surface cuts the three directions' neighbours about equally often.
  const double slack = 6 * std::sqrt(3.0 * cut) * mass;
  const MassProperties grid = mass_properties(particles);
  const MassProperties exact = transformed(mass_properties(shape, density), pose);
  EXPECT_NEAR(exact.mass, grid.mass, slack);
  EXPECT_NEAR((exact.center_of_mass - grid.center_of_mass).norm(), 0, slack / exact.mass * radius);
  EXPECT_NEAR((exact.J - grid.J).norm(), 0, slack * radius * radius);
  EXPECT_LT(slack, 0.1 * exact.mass);  // fine enough to tell a wrong formula
}

TEST(MassProperties, AgreeWithAGridOfParticles) {
  const auto flat = [](const Vec3& p) { return std::hypot(p.x(), p.y()); };
  expect_like_grid(Sphere{1}, [](const Vec3& p) { return p.norm() < 1; });
  expect_like_grid(Box{Vec3(1, 1.2, 1.4)}, [](const Vec3& p) {
    return (p.cwiseAbs() - Vec3(0.5, 0.6, 0.7)).maxCoeff() < 0;
  });
  expect_like_grid(Capsule{0.5, 0.8}, [&](const Vec3& p) {
    return std::hypot(flat(p), std::max(0.0, std::abs(p.z()) - 0.4)) < 0.5;
  });
  expect_like_grid(Cylinder{0.6, 1.1},
                   [&](const Vec3& p) { return flat(p) < 0.6 && std::abs(p.z()) < 0.55; });
  expect_like_grid(Cone{0.9, 1.5}, [&](const Vec3& p) {
    return std::abs(p.z()) < 0.75 && flat(p) < 0.9 * (0.5 - p.z() / 1.5);
  });
  expect_like_grid(Ellipsoid{Vec3(0.8, 1, 1.2)},
                   [](const Vec3& p) { return p.cwiseQuotient(Vec3(0.8, 1, 1.2)).norm() < 1; });
  const Vec3 octahedron[] = {Vec3(1, 0, 0),  Vec3(0, 1, 0),  Vec3(0, 0, 1.3),
                             Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -0.9)};
  expect_like_grid(convex_hull(octahedron), [](const Vec3& p) {
    return std::abs(p.x()) + std::abs(p.y()) + std::max(p.z() / 1.3, -p.z() / 0.9) < 1;
  });
}

// Compounds ---------------------------------------------------------------------------------------

TEST(CombinedMassProperties, OfASolidCutInTwoAreThoseOfTheWhole) {
  const double rho = 900;
  const std::array<MassProperties, 2> boxes = {
      transformed(mass_properties(Box{Vec3(0.3, 1, 2)}, rho),
                  {Vec3(-0.35, 0, 0), Quat::Identity()}),
      transformed(mass_properties(Box{Vec3(0.7, 1, 2)}, rho),
                  {Vec3(0.15, 0, 0), Quat::Identity()})};
  expect_same(combined(boxes), mass_properties(Box{Vec3(1, 1, 2)}, rho), 2, kRounding);

  const std::array<MassProperties, 2> rods = {
      transformed(mass_properties(Cylinder{0.4, 1}, rho), {Vec3(0, 0, -1), Quat::Identity()}),
      transformed(mass_properties(Cylinder{0.4, 2}, rho), {Vec3(0, 0, 0.5), Quat::Identity()})};
  expect_same(combined(rods), mass_properties(Cylinder{0.4, 3}, rho), 3, kRounding);

  // A cube cut obliquely, through four of its edges.
  std::vector<Vec3> low, high, whole;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1, (i & 2) / 2, (i & 4) / 4);
    whole.push_back(corner);
    (i & 4 ? high : low).push_back(corner);
  }
  for (int i = 0; i < 4; ++i) {
    const double x = i & 1, y = (i & 2) / 2;
    low.emplace_back(x, y, 0.3 + 0.4 * x - 0.1 * y);
    high.push_back(low.back());
  }
  const std::array<MassProperties, 2> halves = {mass_properties(convex_hull(low), rho),
                                                mass_properties(convex_hull(high), rho)};
  expect_same(combined(halves), mass_properties(convex_hull(whole), rho), 1, kRounding);
}

TEST(CombinedMassProperties, KeepTheirPrincipalMomentsWhenTheWholeIsMoved) {
  const std::array<MassProperties, 2> parts = {
      mass_properties(Cone{0.3, 1.2}, 500),
      transformed(mass_properties(Box{Vec3(1, 0.2, 0.4)}, 800),
                  {Vec3(0.5, 0.1, 0), Quat(0, 0, 0, 1)})};
  const Pose pose{Vec3(3, -2, 1), Quat(0.4, 0.1, -0.7, 0.2).normalized()};
  const std::array<MassProperties, 2> moved = {transformed(parts[0], pose),
                                               transformed(parts[1], pose)};
  const MassProperties a = combined(parts), b = combined(moved);
  expect_same(b, transformed(a, pose), 4, kRounding);
  EXPECT_NEAR((principal_moments(a.J) - principal_moments(b.J)).norm(), 0, kRounding * a.mass * 16);
}

TEST(ParticleMassProperties, AreThoseOfADumbbell) {
  const Particle dumbbell[] = {{2, Vec3(1, 0, 0)}, {6, Vec3(3, 0, 0)}};
  const MassProperties m = mass_properties(dumbbell);
  EXPECT_DOUBLE_EQ(m.mass, 8);
  EXPECT_TRUE(m.center_of_mass.isApprox(Vec3(2.5, 0, 0)));
  EXPECT_TRUE(m.J.isApprox(Mat3(Vec3(0, 6, 6).asDiagonal())));  // reduced mass 1.5, distance 2
}

}  // namespace
}  // namespace poinsot
