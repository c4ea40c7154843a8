// The scene of the fault tests, and what they all ask of it: balls that never stop bouncing, so
// that every frame has a hash of its own, and that no fault may change.

#pragma once

#include <string>

#include <gtest/gtest.h>

#include "faults/witness.h"
#include "system/programs.h"

namespace poinsot::faults {

inline constexpr const char* kWorld = "bouncing_balls";

// All that the witness saw, `at_least` frames of it, is as if nobody had disturbed the run.
inline void expect_undisturbed(const Witness& witness, std::size_t at_least) {
  const auto seen = witness.seen();
  ASSERT_GE(seen.size(), at_least);
  const std::string file = std::string(POINSOT_SCENES) + "/" + kWorld + ".yaml";
  const auto expected = undisturbed_hashes(file, seen.rbegin()->first);
  for (const auto& [frame, hash] : seen) ASSERT_EQ(hash, expected.at(frame)) << frame;
}

// Prints what the machine may have a share in and nothing is asserted of.
inline void print_pace(const Json& status) {
  std::printf("frame %s, overruns %s, commands refused %s, snapshots dropped %s\n",
              status["frame"].dump().c_str(), status["overruns"].dump().c_str(),
              status["commands_refused"].dump().c_str(),
              status["snapshots_dropped"].dump().c_str());
}

}  // namespace poinsot::faults
