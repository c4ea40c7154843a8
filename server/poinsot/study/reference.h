// Reference: what errors are measured against, computed by several methods side by side and
// certified by their agreement.
//
// A run in closed form throughout shares nothing with one in steps, not even rounding: it is the
// reference, and the other that agrees with it best certifies it. Among runs in steps the one in
// the middle is the reference, and all others must agree with it: sums over the same steps may be
// wrong in the same way.
//
// The certificate at a time is the largest difference from the certifying runs up to then. It
// grows; where it passes the limit the horizon is reached: nobody knows where the bodies are after
// that.

#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <vector>

#include "poinsot/study/path.h"
#include "poinsot/study/study.h"

namespace poinsot {

struct Reference {
  Path path;
  std::vector<PoseError> certificate;  // up to each kept frame, frame 0 first
  std::uint64_t frames = 0;            // the horizon: the last kept frame
  std::uint64_t stride = 1;            // frames from one kept frame to the next
  ReferenceInfo info;
};

struct ReferenceOptions {
  std::uint64_t frames = 0;             // asked for
  std::uint64_t max_poses = 2'000'000;  // of a path, some 120 MB: where there are more, fewer
                                        // frames are kept
  PoseError limit;                      // of the disagreement
  std::chrono::steady_clock::time_point deadline;
  std::function<void(double)> progress = [](double) {};  // 0 … 1
};

// The methods at their tightest: closed form and series, the series, DOP853.
std::vector<Setting> reference_settings(const Scene& scene);

// Runs the scene with the candidates, two or more, side by side. frames is 0 if they do not agree
// on one frame.
Reference make_reference(const Scene& scene, const std::vector<Setting>& candidates,
                         const ReferenceOptions& options, std::stop_token stop);

// The disagreement that ends the horizon: 1e-6 rad and 1e-6 of the largest body's radius of
// gyration, and a tenth of the wanted error (0: none) in m and rad if that is less.
PoseError agreement_limit(const Scene& scene, double wanted_error);

}  // namespace poinsot
