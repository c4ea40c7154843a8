// Path: where the bodies of a run were, at every stride-th frame.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/study/study.h"

namespace poinsot {

class Path {
 public:
  void keep(const PoseSnapshot& snapshot);  // frames in order
  void cut(std::size_t frames);             // to so many kept frames

  std::size_t size() const { return poses_.size(); }  // kept frames
  // How far the snapshot is from kept frame k: the largest of all bodies.
  PoseError distance(std::size_t k, const PoseSnapshot& snapshot) const;
  // The same between the last frames of two paths.
  static PoseError last_distance(const Path& a, const Path& b);

 private:
  std::vector<std::vector<Pose>> poses_;
};

// Frames between two that are kept, so that a path of so many frames and bodies stays below some
// hundred megabytes. At least 1.
std::uint64_t stride_for(std::uint64_t frames, std::size_t bodies);

}  // namespace poinsot
