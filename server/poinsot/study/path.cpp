#include "poinsot/study/path.h"

#include <algorithm>

#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

PoseError distance_of(const Vec3& c1, const Quat& q1, const Vec3& c2, const Quat& q2) {
  return {(c1 - c2).norm(), angle_between(q1, q2)};
}

}  // namespace

void Path::keep(const PoseSnapshot& snapshot) {
  std::vector<Pose>& frame = poses_.emplace_back();
  frame.reserve(snapshot.bodies.size());
  for (const BodyState& body : snapshot.bodies) frame.push_back({body.position, body.orientation});
}

void Path::cut(std::size_t frames) {
  poses_.resize(std::min(frames, poses_.size()));
}

void Path::thin() {
  thin_out(poses_);
}

PoseError Path::distance(std::size_t k, const PoseSnapshot& snapshot) const {
  PoseError error;
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const BodyState& body = snapshot.bodies[i];
    const Pose& pose = poses_[k][i];
    error = largest(error, distance_of(pose.c, pose.q, body.position, body.orientation));
  }
  return error;
}

PoseError Path::last_distance(const Path& a, const Path& b) {
  PoseError error;
  for (std::size_t i = 0; i < a.poses_.back().size(); ++i) {
    const Pose &x = a.poses_.back()[i], &y = b.poses_.back()[i];
    error = largest(error, distance_of(x.c, x.q, y.c, y.q));
  }
  return error;
}

}  // namespace poinsot
