// What of the simulation layer crosses frames, as bytes and back (base/archive.h).

#include <algorithm>

#include "poinsot/base/archive.h"
#include "poinsot/simulation/column_check.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {
namespace {

// Frozen bodies become what they were, and others frozen; more does not change in a run.
void change_motion(World& world, Eigen::Index i, Motion to) {
  const auto k = static_cast<std::size_t>(i);
  const Motion from = world.motion[k];
  if (from == to) return;
  const bool heavy = world.mass[k] == 0;
  if (to == Motion::frozen && from != Motion::fixed && from != Motion::absent) {
    world.freeze(i);
  } else if (from == Motion::frozen && to == Motion::dynamic && !heavy) {
    world.thaw(i);
  } else if (from == Motion::frozen && to == Motion::kinematic && !world.kinematic.empty()) {
    world.motion[k] = to;
  } else {
    ByteReader::fail();
  }
}

}  // namespace

// Masses, inertias, springs and drag follow from the scene. A body that was frozen may still have
// its tethers.
template <class Archive>
void World::archive(Archive& with) {
  with(time);
  for (Eigen::Index i = 0; i < size(); ++i) {
    Motion to = motion[static_cast<std::size_t>(i)];
    with.choice(to, Motion::absent);
    if constexpr (Archive::kReads) change_motion(*this, i, to);
  }
  with.raw(y.data(), static_cast<std::size_t>(y.size()) * sizeof(double));
  if constexpr (Archive::kReads)
    for (Eigen::Index i = 0; i < size(); ++i)
      if (motion[static_cast<std::size_t>(i)] == Motion::fixed) move_anchors(*this, i);
  for (std::size_t k = 0; k < kinematic.size(); ++k)  // frozen or not
    if (motion[k] == Motion::kinematic || (motion[k] == Motion::frozen && mass[k] == 0))
      with(kinematic[k]);
  with.some(held, [&](std::size_t k) { return !held[k].is_zero(); });
  with(tethers);
  if constexpr (Archive::kReads) {
    const bool sound = std::all_of(tethers.begin(), tethers.end(), [&](const Tether& tether) {
      return tether.column >= 0 && tether.column < size() &&
             mass[static_cast<std::size_t>(tether.column)] > 0;
    });
    if (!sound) with.fail();
    link_tethers(*this);
  }
}

// Which bodies are driven is asked for at the start of every frame; workspaces are scratch.
template <class Archive>
void SimulationLayer::archive(Archive& with) {
  with(world_);
  if constexpr (Archive::kReads) own_.front().prepare(world_);
  with.some(contact_wrenches_, [&](std::size_t k) { return !is_zero(contact_wrenches_[k]); });
  for (Eigen::Index i = 0; i < world_.size(); ++i) {
    bool same = same_column(world_.y, last_good_, i);
    with(same);
    if (!same) {
      with.raw(last_good_.col(i).data(), 13 * sizeof(double));
    } else if constexpr (Archive::kReads) {
      last_good_.col(i) = world_.y.col(i);
    }
  }
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    with.choice(methods_[k], Method::explicit_euler);
    if constexpr (Archive::kReads)
      if (!flights_.empty()) turning_known_[k] = 0;
    if (methods_[k] != Method::flight) continue;
    if (flights_.empty()) ByteReader::fail();
    with(flights_[k], turning_known_[k]);
    if (turning_known_[k] != 0) with(turning_[k]);
  }
  for (auto* memories : {&memories_, &system_memories_})
    with.some(*memories, [&](std::size_t k) { return (*memories)[k] != StepMemory{}; });
  with(total_, frame_error_);
}

bool SimulationLayer::attach(Course& course, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  if (course.kind() == Course::Kind::flight && methods_[k] != Method::flight) return false;
  course.attach(world_, i, flights_.empty() ? nullptr : &flights_[k], this);
  return true;
}

template void World::archive(ByteWriter&);
template void World::archive(ByteReader&);
template void SimulationLayer::archive(ByteWriter&);
template void SimulationLayer::archive(ByteReader&);

}  // namespace poinsot
