// Impact searches compared: work, time, error and misses of each, beside fixed steps, on slow,
// fast-spinning and grazing scenes; and random fly-bys of every pair of shapes against dense
// sampling.
//
//   bench_impact_searches [fly-bys per pair]

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "poinsot/collision/proximity.h"
#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

using Search = SearchResult (*)(const CoursePair&, const SearchSpan&, SearchMemory&, SearchWork&);

// What a simulation with fixed steps sees: the first step at whose end the pair overlaps.
template <int kRate>
SearchResult fixed_steps(const CoursePair& pair, const SearchSpan& span, SearchMemory& memory,
                         SearchWork& work) {
  ++work.searches;
  GapHint hint{memory.axis, memory.axis != Vec3::Zero()};
  for (int k = 1; span.from + k / static_cast<double>(kRate) <= span.to; ++k) {
    const double t = span.from + k / static_cast<double>(kRate);
    ++work.poses;
    ++work.gaps;
    const Gap gap = find_gap(pair.a, pair.course_a.at(t) * pair.a.in_body, pair.b,
                             pair.course_b.at(t) * pair.b.in_body, &hint);
    if (gap.value <= 0) return {Meeting::impact, t, gap.normal, gap.point_a};
  }
  return {Meeting::none, span.to, Vec3::Zero(), Vec3::Zero()};
}

struct Method {
  const char* name;
  Search search;
};
constexpr std::array<Method, 5> kMethods = {{{"conservative", search_conservative},
                                             {"backtracking", search_backtracking},
                                             {"continuous", search_continuous},
                                             {"fixed 1/60 s", fixed_steps<60>},
                                             {"fixed 1/240 s", fixed_steps<240>}}};

struct Case {
  FlyBy bodies;
  double end;                   // [s]
  std::optional<double> truth;  // [s] time of the first impact
};

struct Tally {
  int impacts = 0, missed = 0, late = 0, false_alarms = 0, unsure = 0;
  std::vector<double> errors;  // [s] of those that are neither missed nor late
  double depth = 0, microseconds = 0;
  SearchWork work;

  void add(const Method& method, const Case& c, double late_by) {
    const CoursedPair pair(c.bodies.a, c.bodies.b, c.end, c.bodies.gravity);
    SearchMemory memory;
    const auto start = std::chrono::steady_clock::now();
    const SearchResult r = method.search(pair.pair(), pair.span(), memory, work);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    microseconds += took.count();
    const bool found = r.meeting == Meeting::impact;
    unsure += r.meeting == Meeting::unsure;
    impacts += c.truth.has_value();
    if (found) depth = std::max(depth, -pair.gap(r.time));
    if (found && !c.truth) false_alarms += pair.gap(r.time) > 1e-9;
    if (!c.truth || r.meeting == Meeting::unsure) return;
    if (!found) {
      ++missed;
    } else if (r.time > *c.truth + late_by) {
      ++late;
    } else {
      errors.push_back(std::abs(r.time - *c.truth));
    }
  }
  void print(const char* scene, const char* method) {
    std::sort(errors.begin(), errors.end());
    const double n = static_cast<double>(work.searches);
    std::printf(
        "| %-8s | %-13s | %6.1f | %5.1f | %6.2f | %7.0e | %7.0e | %7.0e | %4d | %4d | %4d |\n",
        scene, method, static_cast<double>(work.poses) / n, static_cast<double>(work.gaps) / n,
        microseconds / n, errors.empty() ? 0 : errors[errors.size() / 2],
        errors.empty() ? 0 : errors.back(), depth, missed, late, unsure);
  }
};

Case sampled(FlyBy bodies, double end, double dt) {
  const CoursedPair pair(bodies.a, bodies.b, end, bodies.gravity);
  return {std::move(bodies), end, dense_samples(pair, dt).meets};
}

int solid(Random& random) {
  constexpr std::array<int, 4> kKinds = {kBox, kCapsule, kCylinder, kConvex};
  return kKinds[static_cast<std::size_t>(random.below(4))];
}

std::vector<Case> slow_scenes() {
  Random random(1);
  std::vector<Case> cases;
  while (cases.size() < 300) {
    const int other = cases.size() % 2 == 0 ? static_cast<int>(kHalfSpace) : solid(random);
    FlyBy f = random_fly_by(solid(random), other, 3, random);
    if (CoursedPair(f.a, f.b, 1, f.gravity).gap(0) > 1e-6)
      cases.push_back(sampled(std::move(f), 1, 1e-4));
  }
  return cases;
}

std::vector<Case> spinning_scenes() {
  Random random(2);
  std::vector<Case> cases;
  while (cases.size() < 300) {
    const auto spin = [&] { return Vec3(random.uniform(50, 300) * random.direction()); };
    const BodyDef top = moving(Box{{0.5, 0.3, 0.1}}, {0, 0, 0.8},
                               Vec3(0, 0, random.uniform(-3, -0.5)), spin(), random.rotation());
    FlyBy f{top, ground(), {0, 0, -9.81}};
    if (cases.size() % 2 != 0)
      f.b = moving(Box{{0.4, 0.4, 0.2}}, Vec3::Zero(), Vec3::Zero(), spin(), random.rotation());
    cases.push_back(sampled(std::move(f), 1, 1e-5));
  }
  return cases;
}

// Balls past each other and under a ceiling, within ±1e-9 … 1e-4 m of touching: closed forms.
std::vector<Case> grazing_scenes() {
  Random random(3);
  std::vector<Case> cases;
  const auto ball = [](const Vec3& at, const Vec3& v) {
    return moving(Sphere{0.1}, at, v, Vec3(0, 0, 1));
  };
  while (cases.size() < 300) {
    const double clearance = (random.below(2) == 0 ? 1 : -1) * random.log_uniform(1e-9, 1e-4);
    const double v = random.uniform(0.5, 5), start = random.uniform(0.3, 0.4);
    Case c{{}, 1, std::nullopt};
    if (cases.size() % 2 == 0) {
      const double pass = 0.2 + clearance;
      c.bodies = {ball({-start, pass, 0}, {v, 0, 0}), ball(Vec3::Zero(), Vec3::Zero()),
                  Vec3::Zero()};
      if (clearance < 0) c.truth = (start - std::sqrt((0.2 - pass) * (0.2 + pass))) / v;
    } else {
      BodyDef ceiling = ground();
      ceiling.shapes[0].shape = HalfSpace{-Vec3::UnitZ(), -start - 0.1};
      const double rise = std::sqrt(2 * 9.81 * (start - clearance));
      c.bodies = {ball(Vec3::Zero(), {v, 0, rise}), ceiling, {0, 0, -9.81}};
      if (clearance < 0) c.truth = (rise - std::sqrt(-2 * 9.81 * clearance)) / 9.81;
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

void compare(const char* scene, const std::vector<Case>& cases) {
  for (const Method& method : kMethods) {
    Tally tally;
    const double late_by = std::string(method.name).starts_with("fixed 1/6")   ? 1.0 / 60 + 1e-6
                           : std::string(method.name).starts_with("fixed 1/2") ? 1.0 / 240 + 1e-6
                                                                               : 1e-6;
    for (const Case& c : cases) tally.add(method, c, late_by);  // warms up
    tally = {};
    for (const Case& c : cases) tally.add(method, c, late_by);
    tally.print(scene, method.name);
  }
}

void fly_by(int n) {
  Tally sum;
  int pairs = 0;
  for (int a = kSphere; a <= kConvex; ++a)
    for (int b = a; b <= kHalfSpace; ++b) {
      Random random(1000 + static_cast<std::uint64_t>(10 * a + b));
      Tally tally;
      int passes = 0;
      while (passes < n) {
        FlyBy f = random_fly_by(a, b, passes % 4 == 0 ? 300 : 10, random);
        if (CoursedPair(f.a, f.b, 1, f.gravity).gap(0) <= 1e-6) continue;
        ++passes;
        tally.add(kMethods[0], sampled(std::move(f), 1, 2e-4), 1e-6);
      }
      ++pairs;
      std::printf(
          "%-10s %-10s impacts %6d missed %d late %d false %d unsure %d depth %.0e poses %.1f "
          "gaps %.1f %.1f us\n",
          name_of(a).c_str(), name_of(b).c_str(), tally.impacts, tally.missed, tally.late,
          tally.false_alarms, tally.unsure, tally.depth, static_cast<double>(tally.work.poses) / n,
          static_cast<double>(tally.work.gaps) / n, tally.microseconds / n);
      std::fflush(stdout);
      sum.impacts += tally.impacts;
      sum.missed += tally.missed;
      sum.late += tally.late;
      sum.false_alarms += tally.false_alarms;
      sum.unsure += tally.unsure;
    }
  std::printf("%d pairs, %d fly-bys each: impacts %d missed %d late %d false %d unsure %d\n", pairs,
              n, sum.impacts, sum.missed, sum.late, sum.false_alarms, sum.unsure);
}

}  // namespace
}  // namespace poinsot::test

int main(int argc, char** argv) {
  using namespace poinsot::test;
  std::printf("300 seconds of flight each; errors in s (half of them, the largest), depth in m\n");
  std::printf(
      "| scene    | search        |  poses |  gaps |     us |   error | largest |   depth | "
      "miss | late | unsure |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  compare("slow", slow_scenes());
  compare("spinning", spinning_scenes());
  compare("grazing", grazing_scenes());
  fly_by(argc > 1 ? std::atoi(argv[1]) : 100);
}
