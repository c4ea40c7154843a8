// What the layer moves each body by, what it reports about it, and what it costs in allocations.

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/allocation_counter.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

constexpr double kFrame = 1.0 / 60;

void run(SimulationLayer& layer, int frames) {
  const double start = layer.world().time;
  for (int n = 1; n <= frames; ++n) {
    layer.advance_to(start + n * kFrame);
  }
}

HeldWrench pushes() {
  HeldWrench held;
  held.in_W = {{1, 2, 3}, {0.1, 0.4, -0.3}};
  held.in_B = {{1, 2, 3}, {0.3, -0.2, 0.5}};
  held.add_force_at({0.2, 0.1, -0.3}, {2, 0, 1});
  return held;
}

BodyDef named(const std::string& name, const Vec3& c) {
  BodyDef def = test::tumbler();
  def.name = name;
  def.pose.c = c;
  return def;
}

Scene sprung_pair(double stiffness, double damping) {
  Scene scene = test::scene({named("a", {0, 0, 0}), named("b", {2, 0, 0})});
  scene.springs = {
      test::spring("a", Vec3(0.1, 0, 0), "b", Vec3(0, 0.2, 0), stiffness, damping, 1.0)};
  return scene;
}

TEST(Methods, AreChosenByNeed) {
  Scene scene =
      test::scene({named("static", {0, 0, 0}), named("free", {0, 0, 9}), named("pushed", {5, 0, 9}),
                   named("dragged", {9, 0, 9}), named("sprung", {15, 0, 9})});
  scene.bodies[0].is_static = true;
  scene.bodies[3].drag = {0, 0.2, 0};
  scene.bodies[3].linear_velocity.setZero();
  scene.springs = {test::spring("sprung", Vec3::Zero(), "", Vec3(15, 0, 12), 20, 0.5, 1.0)};
  SimulationLayer layer(scene);
  layer.world().held[2] = pushes();
  run(layer, 1);
  EXPECT_EQ(layer.methods()[0], Method::none);
  EXPECT_EQ(layer.methods()[1], Method::flight);
  EXPECT_EQ(layer.methods()[2], Method::taylor);
  EXPECT_EQ(layer.methods()[3], Method::dop853);  // |v| has no series at rest
  EXPECT_EQ(layer.methods()[4], Method::taylor);
  layer.world().held[2] = {};
  run(layer, 1);
  EXPECT_EQ(layer.methods()[2], Method::flight);
  EXPECT_EQ(layer.methods()[3], Method::taylor);  // it falls now
  EXPECT_FALSE(layer.is_stiff());
  EXPECT_EQ(layer.quarantined(), 0u);
}

TEST(Methods, AreImplicitForStiffSprings) {
  Scene scene = test::scene({test::free_body("body", 1, {1, 1, 1})});
  scene.simulation.gravity.setZero();
  scene.bodies[0].pose.c = {2, 0, 0};
  scene.springs = {test::spring("body", Vec3::Zero(), "", Vec3::Zero(), 1e6, 1e6, 1.0)};
  SimulationLayer layer(scene);
  run(layer, 60);
  EXPECT_TRUE(layer.is_stiff());
  EXPECT_EQ(layer.methods()[0], Method::rosenbrock);
  // x″ + c x′ + c x = 0 with c = 1e6: the slow mode alone, exp(−t (1 + 1/c)).
  EXPECT_NEAR(position(layer.world().y, 0).x(), 1 + std::exp(-1 - 1e-6), 2e-6);
  EXPECT_EQ(layer.quarantined(), 0u);
}

// It holds its end of the spring; the other body goes on.
TEST(Methods, LeaveAFrozenBodyInASystemWhereItIs) {
  SimulationLayer layer(sprung_pair(50, 0));
  run(layer, 10);
  const StateArray before = layer.world().y;
  momentum(layer.world().y, 0).x() = std::numeric_limits<double>::quiet_NaN();
  Tally tally;
  const Eigen::Index spoilt = 0;
  layer.freeze_unsound({&spoilt, 1}, tally);
  layer.commit(layer.world().time, tally);
  run(layer, 60);
  EXPECT_EQ(layer.quarantined(), 1u);
  EXPECT_EQ(layer.methods()[0], Method::none);
  EXPECT_EQ(layer.methods()[1], Method::taylor);
  EXPECT_NEAR((layer.world().y.col(0).head<7>() - before.col(0).head<7>()).norm(), 0, 1e-15);
  EXPECT_GT((position(layer.world().y, 1) - position(before, 1)).norm(), 1);
}

struct Integrator {
  IntegratorKind kind;
  Method method;
};
void PrintTo(const Integrator& integrator, std::ostream* out) {
  *out << name_of<IntegratorKind>(kIntegratorNames, integrator.kind);
}

class Layers : public testing::TestWithParam<Integrator> {
 protected:
  Scene with_integrator(Scene scene) const {
    scene.simulation.integrator = GetParam().kind;
    return scene;
  }
};

TEST_P(Layers, MoveEveryBodyByTheIntegratorThatWasAskedFor) {
  SimulationLayer layer(with_integrator(test::scene({test::tumbler()})));
  layer.world().held[0] = pushes();
  run(layer, 2);
  EXPECT_EQ(layer.methods()[0], GetParam().method);
}

TEST_P(Layers, LeaveStaticBodiesUntouchedBitForBit) {
  Scene scene = test::scene({named("still", {0.1, 0.2, 0.3}), named("falls", {0, 0, 9})});
  scene.bodies[0].is_static = true;
  scene.bodies[0].pose.q = Quat(0.1, 0.2, 0.3, 0.4).normalized();
  SimulationLayer layer(with_integrator(scene));
  const StateArray before = layer.world().y;
  run(layer, 30);
  EXPECT_EQ(layer.world().y.col(0), before.col(0));
  EXPECT_EQ(layer.methods()[0], Method::none);
}

// The steady state, for bodies that are free, pushed and dragged, and for springs.
TEST_P(Layers, DoNotAllocateInTheSteadyState) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "a sanitizer has its own malloc";
  for (const double damping : {0.0, 3e4}) {  // the second is stiff
    Scene scene = sprung_pair(damping > 0 ? 1e4 : 50, damping);
    scene.bodies.push_back(named("free", {0, 9, 0}));
    scene.bodies.push_back(named("pushed", {0, 19, 0}));
    scene.bodies.push_back(named("dragged", {0, 29, 0}));
    scene.bodies[4].drag = {0.1, 0.2, 0.1};
    SimulationLayer layer(with_integrator(scene));
    layer.world().held[3] = pushes();
    run(layer, 40);
    const std::size_t before = test::allocations();
    run(layer, 40);
    EXPECT_EQ(test::allocations(), before) << damping;
  }
}

// Work of everything that acts but gravity and springs, against the change of energy. What the
// method itself gets wrong in a second is measured by two steps: its order is tested elsewhere.
TEST_P(Layers, MeasureWorkAsTheChangeOfEnergy) {
  const double allowed = GetParam().kind == IntegratorKind::explicit_euler ||
                                 GetParam().kind == IntegratorKind::semi_implicit_euler
                             ? 2.0  // first order: some percent of 60 J
                             : 1e-4;
  struct Forcing {
    HeldWrench held;
    Wrench contact;
    DragDef drag;
    bool spring;
  };
  HeldWrench couple_W, push_B, at_point;
  couple_W.in_W.torque = {0.1, 0.4, -0.3};
  push_B.in_B = {{1, 2, 3}, {0.3, -0.2, 0.5}};
  at_point.add_force_at({0.2, 0.1, -0.3}, {2, 0, 1});
  const Wrench contact{{0, 1, 2}, {0.2, 0, 0.1}};
  for (const Forcing& forcing : {Forcing{couple_W, {}, {}, false}, Forcing{push_B, {}, {}, false},
                                 Forcing{at_point, {}, {}, false}, Forcing{{}, contact, {}, false},
                                 Forcing{{}, {}, {0.3, 0.2, 0.4}, false}, Forcing{{}, {}, {}, true},
                                 Forcing{pushes(), contact, {0.3, 0.2, 0.4}, true}}) {
    Scene scene = test::scene({test::tumbler()});
    scene.simulation.step = 1.0 / 960;
    scene.bodies[0].drag = forcing.drag;
    if (forcing.spring)
      scene.springs = {test::spring("tumbler", Vec3(0.1, 0.2, 0), "", Vec3(0, 0, 3), 20, 0.5, 1.0)};
    SimulationLayer layer(with_integrator(scene));
    layer.world().held[0] = forcing.held;
    const double before = kinetic_energy(layer.world()) + potential_energy(layer.world());
    for (int n = 1; n <= 60; ++n) {
      if (!forcing.contact.force.isZero(0)) layer.contact_wrenches()[0] = forcing.contact;
      layer.advance_to(n * kFrame);
    }
    const double after = kinetic_energy(layer.world()) + potential_energy(layer.world());
    EXPECT_NEAR(after - before, layer.work(), allowed);
    if (!forcing.spring || !forcing.held.is_zero()) {
      EXPECT_GT(std::abs(layer.work()), 0.1);
    }
    if (GetParam().kind <= IntegratorKind::taylor) {
      EXPECT_NEAR(after - before, layer.work(), 1e-11);
    }
  }
}

TEST_P(Layers, ReportErrorsThatAreOfTheSizeOfTheErrors) {
  Scene scene = test::scene({test::tumbler()});
  SimulationLayer layer(with_integrator(scene));
  layer.world().held[0] = pushes();
  test::ExtendedReference exact = test::reference_of(layer.world(), test::kQuick);
  LocalError sum;
  for (int n = 1; n <= 60; ++n) {
    layer.advance_to(n * kFrame);
    sum += layer.local_error();
  }
  exact.advance_to(layer.world().time);
  const double error = exact.orientation_error(Quat(orientation(layer.world().y, 0)));
  // Local errors grow on their way by a factor of some; those of fixed steps are estimated in every
  // sixteenth advance, so a sum over all misses up to fifteen of sixteen.
  EXPECT_GE(sum.orientation * (is_adaptive(GetParam().kind) ? 10 : 160), error - 1e-13);
  if (is_adaptive(GetParam().kind)) {
    EXPECT_LE(sum.orientation, 1e-5);
  }
  EXPECT_LE(layer.momentum_error(), GetParam().kind <= IntegratorKind::taylor ? 1e-13 : 0.05);
  EXPECT_TRUE(std::isfinite(layer.momentum_error()));
}

std::string name_of_layer(const testing::TestParamInfo<Integrator>& info) {
  return std::string(name_of<IntegratorKind>(kIntegratorNames, info.param.kind));
}
INSTANTIATE_TEST_SUITE_P(
    All, Layers,
    testing::Values(Integrator{IntegratorKind::exact, Method::taylor},
                    Integrator{IntegratorKind::taylor, Method::taylor},
                    Integrator{IntegratorKind::dop853, Method::dop853},
                    Integrator{IntegratorKind::dopri5, Method::dopri5},
                    Integrator{IntegratorKind::rk4, Method::rk4},
                    Integrator{IntegratorKind::semi_implicit_euler, Method::semi_implicit_euler},
                    Integrator{IntegratorKind::explicit_euler, Method::explicit_euler}),
    name_of_layer);

TEST(LayerTable, IsCoveredByThisSuite) {
  EXPECT_EQ(kIntegratorNames.size(), 7u);
}

}  // namespace
}  // namespace poinsot
