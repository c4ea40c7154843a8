#include "poinsot/simulation/integration.h"

#include <algorithm>
#include <limits>

namespace poinsot {
namespace {

// The series stop at rounding; a pair that stands in for them is kept close to it.
constexpr double kRounding = 1e-14, kStandIn = 1e-12, kDefaultTolerance = 1e-8;
// An implicit method of order 4 would need a thousand steps a frame for more.
constexpr double kImplicit = 1e-9;
constexpr int kMostSeries = 64, kMostSteps = 20000;  // per advance
// An estimate of the error of fixed steps costs three of them: it is taken now and then.
constexpr std::uint32_t kEstimateEvery = 16;

double tolerance_of(const SimulationDef& def) {
  if (def.tolerance > 0) return def.tolerance;
  const bool series =
      def.integrator == IntegratorKind::exact || def.integrator == IntegratorKind::taylor;
  return series ? kRounding : kDefaultTolerance;
}

}  // namespace

Workspace::Workspace(std::size_t n) : state(17, static_cast<Eigen::Index>(n)), bodies(n), rates(n) {
  embedded.prepare(state.cols());
  fixed.prepare(state.cols());
}

Integration::Integration(const Scene& scene)
    : kind_(scene.simulation.integrator),
      longest_step_(scene.simulation.step > 0 ? scene.simulation.step
                                              : scene.collision.contact_step),
      tolerance_(tolerance_of(scene.simulation)) {}

Method Integration::advance(const System& system, Workspace& work, TaylorSeries& taylor,
                            StepMemory& memory, double duration, LocalError& error) const {
  switch (kind_) {
    case IntegratorKind::exact:
    case IntegratorKind::taylor: {
      if (memory.stiff)
        return by_tolerance(kDop853, Method::dop853, std::max(tolerance_, kStandIn), system, work,
                            memory, duration, error);
      work.before = work.state;
      if (taylor.advance(system, work.state, duration, tolerance_, kMostSeries, error))
        return Method::taylor;
      work.state = work.before;
      error = {};
      return by_tolerance(kDop853, Method::dop853, std::max(tolerance_, kStandIn), system, work,
                          memory, duration, error);
    }
    case IntegratorKind::dop853:
      return by_tolerance(kDop853, Method::dop853, tolerance_, system, work, memory, duration,
                          error);
    case IntegratorKind::dopri5:
      return by_tolerance(kDopri5, Method::dopri5, tolerance_, system, work, memory, duration,
                          error);
    default:
      return by_fixed_steps(system, work, memory, duration, error);
  }
}

Method Integration::by_tolerance(const EmbeddedPair& pair, Method method, double tolerance,
                                 const System& system, Workspace& work, StepMemory& memory,
                                 double duration, LocalError& error) const {
  double done = 0;
  if (!memory.stiff && work.embedded.advance(pair, system, work.state, duration, tolerance,
                                             kMostSteps, memory, error, done))
    return method;
  memory.stiff = true;
  work.rosenbrock.prepare(system.size());
  // What takes too many steps goes on at a looser tolerance; the error tells.
  for (const double loose : {1.0, 1e3, 1e6})
    if (work.rosenbrock.advance(system, work.state, duration,
                                loose * std::max(tolerance, kImplicit), kMostSteps, memory, error,
                                done))
      return Method::rosenbrock;
  error = {};
  // Nothing can follow this motion: the body is frozen where it was.
  work.state.setConstant(std::numeric_limits<double>::quiet_NaN());
  return method;
}

Method Integration::by_fixed_steps(const System& system, Workspace& work, StepMemory& memory,
                                   double duration, LocalError& error) const {
  const int steps = step_count(duration, longest_step_);
  const double h = duration / steps;
  if (memory.advances++ % kEstimateEvery == 0)
    memory.step_error = work.fixed.compare(kind_, system, work.state, h);
  error = {steps * memory.step_error.position, steps * memory.step_error.orientation};
  for (int s = 0; s < steps; ++s) work.fixed.step(kind_, system, work.state, h);
  switch (kind_) {
    case IntegratorKind::semi_implicit_euler:
      return Method::semi_implicit_euler;
    case IntegratorKind::explicit_euler:
      return Method::explicit_euler;
    default:
      return Method::rk4;
  }
}

}  // namespace poinsot
