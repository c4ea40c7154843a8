// The bodies of a scene by handle, and which of them the user wants to see.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/pose_snapshot.h"

namespace poinsot {

class Roster {
 public:
  Roster() = default;
  // All moving bodies, or those named in `wanted`. Throws Error if a wanted body is unknown (with
  // the nearest name) or static (it is not in the stream of poses).
  Roster(const std::vector<BodyInfo>& bodies, const std::vector<std::string>& wanted);

  // The name of a body that is to be shown; null for one that is not.
  const std::string* shown(BodyId id) const;

  // The name of any body of the scene, moving or not; null for one that is not on the list.
  const std::string* name(BodyId id) const;

  // The daemon process that the list is of.
  std::uint64_t session() const { return session_; }

  // False if the snapshot is of another daemon process or has bodies that are not on the list.
  bool describes(const PoseSnapshot& poses) const;

 private:
  struct Entry {
    std::string name;
    bool shown = true;
  };
  std::uint64_t session_ = 0;
  std::map<BodyId, Entry> entries_;
};

}  // namespace poinsot
