// The scenes of the daemons of one world, followed sample by sample: what is spawned comes in, what
// is removed goes out, and the report says when all is there.
//
// A daemon is known by its session. A report names a revision of the scene and how many bodies it
// has; a body carries the revision that it came with. Word of a removal carries nothing but the
// body's handle and the session, and who joins gets none of earlier ones: of the first report's
// revision the number of bodies decides alone, later the last change must have come too.

#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/pose_snapshot.h"

namespace poinsot {

class SceneBook {
 public:
  // Bodies are received from now on: of what came and went before, reports alone tell.
  void join();
  void add(BodyInfo body);
  void add(const RunReport& report);
  // The snapshot that a user has read: its bodies are to be known.
  void add(const PoseSnapshot& poses);

  // Of the daemon that is looked at: the one whose poses or report came last.
  bool is_complete() const;
  std::vector<BodyInfo> bodies() const;  // by slot
  std::size_t size() const { return looked_at().bodies.size(); }
  std::size_t expected() const { return looked_at().expected; }
  bool has_report() const { return looked_at().first_report != 0; }
  std::uint32_t revision() const { return looked_at().reported; }

 private:
  struct Sheet {
    std::map<BodyId, BodyInfo> bodies;
    std::uint32_t newest = 0;        // revision of a body
    bool removal_came_last = false;  // of the changes
    std::uint32_t first_report = 0;  // revision; 0: no report yet
    std::uint32_t reported = 0;      // revision of the newest report …
    std::size_t expected = 0;        // … and how many bodies it has
    std::uint32_t epoch = 0;         // … and where the run was then
    std::uint64_t frame = 0;
  };

  const Sheet& looked_at() const;
  bool knows_what_was_read(const Sheet& sheet) const;
  void forget_others();

  std::map<std::uint64_t, Sheet> sheets_;  // by session
  std::uint64_t session_ = 0;              // of the poses or report that came last
  std::uint64_t newest_session_ = 0;       // of the body that came last
  std::vector<BodyId> read_;               // bodies of the snapshot read last …
  std::uint32_t read_epoch_ = 0;           // … and its place in the run
  std::uint64_t read_frame_ = 0;
  std::uint64_t read_session_ = 0;
};

}  // namespace poinsot
