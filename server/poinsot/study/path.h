// Path: where the bodies of a run were, at every so many frames.

#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/study/study.h"

namespace poinsot {

class Path {
 public:
  void keep(const PoseSnapshot& snapshot);  // frames in order
  void cut(std::size_t frames);             // to so many kept frames
  void thin();                              // to every other kept frame, the first included

  std::size_t size() const { return poses_.size(); }  // kept frames
  // How far the snapshot is from kept frame k: the largest of all bodies.
  PoseError distance(std::size_t k, const PoseSnapshot& snapshot) const;
  // The same between the last frames of two paths.
  static PoseError last_distance(const Path& a, const Path& b);

 private:
  std::vector<std::vector<Pose>> poses_;
};

// Every other element, the first included.
template <class Element>
void thin_out(std::vector<Element>& elements) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); i += 2, ++kept)
    if (i != kept) elements[kept] = std::move(elements[i]);
  elements.resize(kept);
}

}  // namespace poinsot
