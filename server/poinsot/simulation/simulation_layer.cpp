#include "poinsot/simulation/simulation_layer.h"

#include <algorithm>
#include <limits>

namespace poinsot {
namespace {

// A coordinate beyond this is no physics any more; its square is still finite.
constexpr double kLargest = 1e100;

// False for NaN as well, and for a quaternion that overflowed while it was made unit.
bool is_sound(const StateArray& y, Eigen::Index i) {
  return (y.col(i).array().abs() < kLargest).all() && orientation(y, i).squaredNorm() > 0.5;
}

}  // namespace

SimulationLayer::SimulationLayer(const Scene& scene)
    : world_(scene),
      integrator_(make_integrator(scene.simulation.integrator, world_.size())),
      longest_step_(scene.simulation.step > 0 ? scene.simulation.step
                                              : std::numeric_limits<double>::infinity()),
      contact_wrenches_(static_cast<std::size_t>(world_.size())),
      last_good_(world_.y),
      work_(world_.size()) {}

void SimulationLayer::advance_to(double t_end) {
  const double duration = t_end - world_.time;
  const Dynamics dynamics{world_, contact_wrenches_};
  work_.start_step(dynamics);
  integrate(integrator_, dynamics, world_.y, duration, longest_step_);
  freeze_unsound();
  work_.end_step(dynamics, duration);
  std::fill(contact_wrenches_.begin(), contact_wrenches_.end(), Wrench{});
  last_good_ = world_.y;
  world_.time = t_end;
}

void SimulationLayer::freeze_unsound() {
  for (Eigen::Index i = 0; i < world_.size(); ++i) {
    if (is_sound(world_.y, i)) continue;
    world_.y.col(i) = last_good_.col(i);
    world_.freeze(i);
    contact_wrenches_[static_cast<std::size_t>(i)] = Wrench{};
    ++quarantined_;
  }
}

}  // namespace poinsot
