// What came into the scene and what left it, for the scene topic. session is left to whoever sends
// it.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/protocol/body_info.h"

namespace poinsot {

class PresentationLayer;

// In this order: what is gone, then what is new or was moved.
struct SceneChange {
  std::vector<BodyId> removed;
  std::vector<BodyInfo> added;

  bool empty() const { return removed.empty() && added.empty(); }
};

class SceneChanges {
 public:
  // What changed since the last call; all bodies in the first one, and when an epoch began with
  // another scene: the same id may be another body there. Empty, at no cost, while the scene's
  // revision stays.
  SceneChange since_last(const PresentationLayer& layer);

 private:
  struct Told {
    BodyId id;  // none: absent
    Pose pose;  // of a static body
  };
  std::uint32_t revision_ = 0;
  std::uint32_t epoch_ = 0;
  std::vector<Told> told_;  // by place
};

}  // namespace poinsot
