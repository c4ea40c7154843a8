// Milliseconds of CPU time per frame of the broad phase and of others, on the same crowds: boxes
// are set, pairs are asked for. All boxes are set each frame, or a share of them. The least of
// three passes, each the mean over its frames; computing the boxes is not in it.
//
//   bench_broad_phase [crowd [bodies]]

#include "poinsot/collision/broad_phase.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "crowds.h"
#include "fcl_tree.h"
#include "level_grid.h"
#include "sweep.h"

namespace poinsot::bench {
namespace {

constexpr double kStep = 0.01;  // [s]

// Of this thread: what else the machine does is not in it.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Result {
  double ms = 0;
  std::size_t pairs = 0;
};

template <class Candidate>
Result measure(Crowd crowd, double share) {
  const std::vector<Collider> colliders = crowd.colliders();
  Candidate candidate(colliders);
  for (int i = 0; i < crowd.count(); ++i) {
    candidate.set_moves(i, crowd.moves[static_cast<std::size_t>(i)]);
    candidate.set(i, crowd.box(i));
  }
  candidate.pairs();
  const int frames = std::clamp(100000 / crowd.count(), 3, 100);
  test::Random random(3);
  std::vector<int> moved;
  std::vector<Aabb> boxes;
  Result result{1e300, 0};
  for (int pass = 0; pass < 3; ++pass) {
    double ms = 0;
    for (int frame = -1; frame < frames; ++frame) {  // the first warms up
      moved.clear();
      boxes.clear();
      for (int i = 0; i < crowd.count(); ++i) {
        if (!crowd.moves[static_cast<std::size_t>(i)] || random.uniform(0, 1) > share) continue;
        crowd.advance(i, kStep);
        moved.push_back(i);
        boxes.push_back(crowd.box(i));
      }
      const double start = cpu_ms();
      for (std::size_t k = 0; k < moved.size(); ++k) candidate.set(moved[k], boxes[k]);
      result.pairs = candidate.pairs().size();
      if (frame >= 0) ms += cpu_ms() - start;
    }
    result.ms = std::min(result.ms, ms / frames);
  }
  return result;
}

struct Kind {
  const char* name;
  Crowd (*make)(int, std::uint64_t);
};
constexpr Kind kKinds[] = {{"gas", gas},       {"pile", pile},         {"mixed", mixed},
                           {"ground", ground}, {"clusters", clusters}, {"sparse", sparse}};

void report(const Kind& kind, int n) {
  const Crowd crowd = kind.make(n, 1);
  for (const double share : {1.0, 0.1, 0.01}) {
    const Result ours = measure<BroadPhase>(crowd, share);
    const Result fcl = measure<FclTree>(crowd, share);
    const Result grid = measure<LevelGrid>(crowd, share);
    const Result sweep = measure<Sweep>(crowd, share);
    const bool agree =
        ours.pairs == fcl.pairs && ours.pairs == grid.pairs && ours.pairs == sweep.pairs;
    std::printf("| %-8s | %6d | %4.0f%% | %5.1f | %8.4f | %8.4f | %8.4f | %9.4f | %5.1f |%s\n",
                kind.name, n, 100 * share, static_cast<double>(ours.pairs) / n, ours.ms, fcl.ms,
                grid.ms, sweep.ms, fcl.ms / ours.ms, agree ? "" : " PAIRS DIFFER");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  using namespace poinsot::bench;
  std::printf(
      "| crowd    | bodies |   set | pairs |     ours |      FCL |     grid |     sweep | ratio "
      "|\n");
  std::printf(
      "|----------|-------:|------:|------:|---------:|---------:|---------:|----------:|------:|"
      "\n");
  for (const Kind& kind : kKinds)
    if (argc < 2 || std::string(argv[1]) == kind.name)
      for (const int n : {100, 1000, 10000, 50000})
        if (argc < 3 || std::atoi(argv[2]) == n) report(kind, n);
}
