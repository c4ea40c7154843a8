#include "contact_measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <signal.h>
#include <stdexcept>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "contact_overlaps.h"

namespace poinsot::bench {
namespace {

constexpr const char* kColumns =
    "case,engine,setting,status,reached_s,bodies,cpu_us_per_s_body,ms_mean,ms_median,ms_p99,error,"
    "error_over_time,extra,penetration_max_m,penetration_mean_m,kinetic_J,lowest_m,lost,rss_MB";
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarAway = 1e3;  // [m]

double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Options {
  std::vector<std::string> cases;
  double limit = 60;  // [s]
  bool defaults = false, header = false, list = false, wall = false;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--limit" && i + 1 < argc) {
      options.limit = std::atof(argv[++i]);
    } else if (argument == "--defaults") {
      options.defaults = true;
    } else if (argument == "--wall") {
      options.wall = true;
    } else if (argument == "--header") {
      options.header = true;
    } else if (argument == "--list") {
      options.list = true;
    } else if (argument == "all" || argument == "accuracy" || argument == "piles") {
      for (const std::string& name : contact_case_names())
        if (argument == "all" ||
            (contact_case(name).question == Question::piles) == (argument == "piles"))
          options.cases.push_back(name);
    } else {
      options.cases.push_back(contact_case(argument).name);
    }
  }
  return options;
}

double larger(double a, double b) {  // what is no number stays so
  return std::isnan(a) || b <= a ? a : b;
}

// One scene from start to end, or to the limit.
struct Course {
  std::vector<double> cpu;                 // [s] per frame
  double moved_most = 0, lifted_most = 0;  // [m] any body, at any output
  std::vector<ContactState> states;        // the last
  bool cut = false;
};

void look(const ContactScene& scene, Course& course) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Vec3 moved = course.states[i].pose.c - scene.bodies[i].pose.c;
    course.moved_most = larger(course.moved_most, moved.norm());
    course.lifted_most = larger(course.lifted_most, moved.z());
  }
}

Course run(const ContactCase& c, const ContactScene& scene, const ContactSetting& setting,
           double limit) {
  Course course;
  course.states.resize(scene.bodies.size());
  const auto world = setting.make(scene);
  for (int frame = 1; frame <= c.frames() && !course.cut; ++frame) {
    const clockid_t clock = setting.by_wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID;
    const double start = seconds(clock);
    world->advance_to(frame / kFrameRate);
    course.cpu.push_back(seconds(clock) - start);
    if (c.question != Question::piles || frame == c.frames()) {
      world->read(course.states);
      look(scene, course);
    }
    course.cut = seconds(CLOCK_PROCESS_CPUTIME_ID) > limit && frame < c.frames();
  }
  if (course.cut) world->read(course.states);
  return course;
}

double time_once(const ContactCase& c, const ContactSetting& setting) {
  double total = 0;
  for (const ContactScene& scene : c.scenes) {
    const auto world = setting.make(scene);
    const double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
    for (int frame = 1; frame <= c.frames(); ++frame) world->advance_to(frame / kFrameRate);
    total += seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
  }
  return total;
}

// CPU time of all frames [s]. Where frames are short, reading the clock at each of them counts
// among the cost: then it is the median over as many runs without as make up kEnough.
double total_time(const ContactCase& c, const ContactSetting& setting,
                  const std::vector<Course>& courses) {
  constexpr double kEnough = 0.1;  // [s]
  double total = 0;
  for (const Course& course : courses)
    for (const double frame : course.cpu) total += frame;
  if (total > kEnough || c.question == Question::piles) return total;
  std::vector<double> times;
  for (double spent = 0; spent < kEnough || times.size() < 3; spent += times.back())
    times.push_back(time_once(c, setting));
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

struct Result {
  double error = kNothing, over_time = kNothing, extra = kNothing;
};

// Displacement in the ground's axes: x down the slope, or ahead.
Vec3 displacement(const ContactScene& scene, const Course& course) {
  return scene.ground.conjugate() * (course.states[0].pose.c - scene.bodies[0].pose.c);
}

double exact_distance(const ContactCase& c) {
  if (c.question == Question::slides)
    return 0.5 * kGravity * (std::sin(kSlopeAngle) - 0.5 * std::cos(kSlopeAngle)) * c.duration *
           c.duration;
  if (c.question == Question::stops)
    return kStopSpeed * kStopSpeed / (2 * kStopFriction * kGravity);
  const double rolls_at = 2 * kRollSpeed / (7 * kRollFriction * kGravity);  // [s]
  return 12 * kRollSpeed * kRollSpeed / (49 * kRollFriction * kGravity) +
         5 * kRollSpeed / 7 * (c.duration - rolls_at);
}

Result judge_standing(const ContactCase& c, const std::vector<Course>& courses) {
  const ContactScene& scene = c.scenes[0];
  Result result{0, courses[0].moved_most, 0};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Vec3 moved = courses[0].states[i].pose.c - scene.bodies[i].pose.c;
    result.error = larger(result.error, moved.norm());
    result.extra = moved.head<2>().norm();
  }
  return result;
}

Result judge_sticking(const ContactCase& c, const std::vector<Course>& courses) {
  Result result{0, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < courses.size(); ++k) {
    const double moved = (courses[k].states[0].pose.c - c.scenes[k].bodies[0].pose.c).norm();
    result.error = larger(result.error, moved);
    result.over_time = larger(result.over_time, courses[k].moved_most);
    least = std::min(least, moved);
  }
  result.extra = result.error - least;
  return result;
}

Result judge_distance(const ContactCase& c, const std::vector<Course>& courses) {
  const double exact = exact_distance(c);
  Result result{0, kNothing, kNothing};
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t k = 0; k < courses.size(); ++k) {
    const Vec3 moved = displacement(c.scenes[k], courses[k]);
    result.error = larger(result.error, std::hypot(moved.x() - exact, moved.y()));
    least = std::min(least, moved.x());
    most = std::max(most, moved.x());
  }
  if (c.question == Question::slides) {
    result.error /= exact;
    result.extra = (most - least) / exact;
  } else if (c.question == Question::stops) {
    result.extra = courses[0].lifted_most;
  } else {
    result.extra = std::abs(courses[0].states[0].velocity.x() - 5 * kRollSpeed / 7);
  }
  return result;
}

Result judge(const ContactCase& c, const std::vector<Course>& courses) {
  if (c.question == Question::piles || courses.size() < c.scenes.size()) return {};
  if (c.question == Question::stands) return judge_standing(c, courses);
  if (c.question == Question::sticks) return judge_sticking(c, courses);
  return judge_distance(c, courses);
}

struct End {
  Overlaps overlaps;
  double kinetic = 0, lowest = std::numeric_limits<double>::infinity();  // [J], [m]
  int lost = 0;
};

End look_at_end(const ContactScene& scene, const std::vector<ContactState>& states) {
  End end;
  std::vector<Pose> poses;
  const Vec3 up = scene.ground * Vec3::UnitZ();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ContactState& s = states[i];
    const ContactBody& b = scene.bodies[i];
    const double height = up.dot(s.pose.c);
    poses.push_back(s.pose);
    if (!(height > 0) || !(s.pose.c.norm() < kFarAway)) ++end.lost;
    end.lowest = std::min(end.lowest, height);
    const Vec3 omega = s.pose.q.conjugate() * s.omega;
    end.kinetic +=
        0.5 * (b.mass * s.velocity.squaredNorm() + omega.dot(b.moments.cwiseProduct(omega)));
  }
  end.overlaps = find_overlaps(scene, poses);
  return end;
}

std::string text(double x) {
  if (std::isnan(x)) return "";
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.4g", x);
  return buffer;
}

std::string time_columns(const ContactCase& c, const std::vector<Course>& courses, double total) {
  std::vector<double> cpu;
  for (const Course& course : courses) cpu.insert(cpu.end(), course.cpu.begin(), course.cpu.end());
  std::sort(cpu.begin(), cpu.end());
  const auto frames = static_cast<double>(cpu.size());
  const auto quantile = [&](double q) {
    return 1e3 * cpu[static_cast<std::size_t>(q * (frames - 1))];
  };
  const auto bodies = static_cast<double>(c.scenes[0].bodies.size());
  return text(1e6 * total * kFrameRate / frames / bodies) + "," + text(1e3 * total / frames) + "," +
         text(quantile(0.5)) + "," + text(quantile(0.99));
}

// Everything between the setting's name and the memory used.
std::string measure_one(const ContactCase& c, const ContactSetting& setting, double limit) {
  std::vector<Course> courses;
  for (const ContactScene& scene : c.scenes) {
    courses.push_back(run(c, scene, setting, limit));
    if (courses.back().cut) break;
  }
  const Course& last = courses.back();
  const bool complete = !last.cut && courses.size() == c.scenes.size();
  const Result result = complete ? judge(c, courses) : Result{};
  End end = look_at_end(c.scenes[courses.size() - 1], last.states);
  return std::string(complete ? "ok" : "cut") + "," +
         text(static_cast<double>(last.cpu.size()) / kFrameRate) + "," +
         std::to_string(last.states.size()) + "," +
         time_columns(c, courses, total_time(c, setting, courses)) + "," + text(result.error) +
         "," + text(result.over_time) + "," + text(result.extra) + "," +
         text(end.overlaps.largest) + "," + text(end.overlaps.mean) + "," + text(end.kinetic) +
         "," + text(end.lowest) + "," + std::to_string(end.lost);
}

// An engine's fault or an endless step ends its process, not the measurement.
[[noreturn]] void run_child(const ContactCase& c, const ContactSetting& setting, double limit,
                            int out) {
  constexpr double kWallPerCpu = 5;  // of a machine that others use as well
  alarm(static_cast<unsigned>(kWallPerCpu * limit));
  std::string row;
  try {
    row = measure_one(c, setting, limit);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s %s: %s\n", c.name.c_str(), setting.name.c_str(), fault.what());
    row = "failed,,,,,,,,,,,,,,";
  }
  const bool written = write(out, row.data(), row.size()) == static_cast<ssize_t>(row.size());
  _exit(written ? 0 : 1);
}

void print_row(const std::string& engine, const ContactCase& c, const ContactSetting& setting,
               double limit) {
  std::fflush(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    dup2(STDERR_FILENO, STDOUT_FILENO);  // engines that print
    run_child(c, setting, limit, ends[1]);
  }
  close(ends[1]);
  std::string row;
  char buffer[512];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof(buffer))) > 0;)
    row.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (row.empty()) {
    const bool late = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
    row = std::string(late ? "timeout" : "crashed") + ",,,,,,,,,,,,,,";
  }
  std::printf("%s,%s,%s,%s,%s\n", c.name.c_str(), engine.c_str(), setting.name.c_str(), row.c_str(),
              text(static_cast<double>(usage.ru_maxrss) / 1024).c_str());
  std::fflush(stdout);
}

}  // namespace

int measure_contacts(const std::string& engine, const ContactSettings& settings, int argc,
                     char** argv) {
  try {
    const Options options = read_options(argc, argv);
    if (options.header) std::printf("%s\n", kColumns);
    for (const std::string& name : options.cases) {
      if (options.list) {
        std::printf("%s\n", name.c_str());
        continue;
      }
      const ContactCase c = contact_case(name);
      for (ContactSetting setting : settings(c)) {
        setting.by_wall = options.wall;
        print_row(engine, c, setting, options.limit);
        if (options.defaults) break;
      }
    }
    return 0;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s: %s\n", engine.c_str(), failure.what());
    return 1;
  }
}

}  // namespace poinsot::bench
