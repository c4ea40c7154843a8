#include "measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "poinsot/math/rotation.h"
#include "reference_file.h"

namespace poinsot::bench {
namespace {

struct Options {
  std::string reference;
  std::string cases;  // a,b; empty: all
  double limit = 15;  // [s]
};

struct Error {
  double orientation = 0;  // [rad]
  double position = 0;     // [m]
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i], value = argv[i + 1];
    if (name == "--reference") options.reference = value;
    if (name == "--cases") options.cases = value;
    if (name == "--limit") options.limit = std::atof(argv[i + 1]);
  }
  if (argc % 2 == 0 || options.reference.empty())
    throw std::runtime_error("usage: --reference FILE [--cases a,b] [--limit S]");
  return options;
}

bool selects(std::string_view list, std::string_view name) {
  if (list.empty()) return true;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    if (list.substr(0, end) == name) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

double cpu_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// A position or an orientation that is no number any more counts as lost, not as exact.
void include(Error& error, const Pose& pose, const Pose& exact) {
  const auto larger = [](double a, double b) { return std::isnan(a) || b <= a ? a : b; };
  error.orientation = larger(error.orientation, angle_between(pose.q, exact.q));
  error.position = larger(error.position, (pose.c - exact.c).norm());
}

struct Run {
  Error error;
  double cpu = 0;  // [s]
};

// Compares every output; nothing if the run would take longer than the limit.
std::optional<Run> compare(const Case& c, const Setting& setting, const std::vector<Pose>& exact,
                           double limit) {
  const auto simulation = setting.make();
  const std::size_t n = c.bodies.size();
  std::vector<Pose> poses(n);
  Run run;
  for (int frame = 1; frame <= c.frames(); ++frame) {
    const double start = cpu_time();
    simulation->advance_to(frame / c.frame_rate);
    run.cpu += cpu_time() - start;
    simulation->read(poses);
    for (std::size_t i = 0; i < n; ++i)
      include(run.error, poses[i], exact[static_cast<std::size_t>(frame - 1) * n + i]);
    // The first steps may be dearer than the rest.
    if (run.cpu > limit || (frame * 10 >= c.frames() && run.cpu * c.frames() / frame > limit))
      return std::nullopt;
  }
  return run;
}

double time_once(const Case& c, const Setting& setting) {
  const auto simulation = setting.make();
  const double start = cpu_time();
  for (int frame = 1; frame <= c.frames(); ++frame) simulation->advance_to(frame / c.frame_rate);
  return cpu_time() - start;
}

// Median over as many runs as make up 0.1 s; where a run is long, reading the clock at each output
// costs nothing against it, and the run that was compared is the measurement.
double cost(const Case& c, const Setting& setting, double compared) {
  constexpr double kEnough = 0.1;  // [s]
  if (compared > kEnough) return compared;
  std::vector<double> times;
  double total = 0;
  while (total < kEnough || times.size() < 3) {
    times.push_back(time_once(c, setting));
    total += times.back();
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  return times[times.size() / 2];
}

void measure_case(const std::string& engine, const Case& c, const std::vector<Setting>& settings,
                  const std::vector<Pose>& exact, double limit) {
  for (const Setting& setting : settings) {
    const std::string name = engine + "," + c.name + "," + setting.name;
    try {
      const std::optional<Run> run = compare(c, setting, exact, limit);
      if (!run) {
        std::fprintf(stderr, "%s: left out, takes more than %g s\n", name.c_str(), limit);
        continue;
      }
      const double per_s =
          cost(c, setting, run->cpu) / c.duration / static_cast<double>(c.bodies.size());
      std::printf("%s,%.3g,%.3g,%.4g\n", name.c_str(), run->error.orientation, run->error.position,
                  1e6 * per_s);
      std::fflush(stdout);
    } catch (const std::exception& failure) {
      std::fprintf(stderr, "%s: left out, %s\n", name.c_str(), failure.what());
    }
  }
}

}  // namespace

int measure(const std::string& engine, const Settings& settings, int argc, char** argv) {
  try {
    const Options options = read_options(argc, argv);
    std::ifstream file(options.reference, std::ios::binary);
    for (const Case& c : cases()) {
      const std::vector<Pose> exact = read_reference(file, c);
      if (selects(options.cases, c.name))
        measure_case(engine, c, settings(c), exact, options.limit);
    }
    return 0;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s: %s\n", engine.c_str(), failure.what());
    return 1;
  }
}

}  // namespace poinsot::bench
