#include "poinsot/cli/watch.h"

#include <optional>
#include <utility>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"
#include "poinsot/cli/pace.h"
#include "poinsot/cli/terminal.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double kTableRate = 10;  // [Hz] what an eye can follow
constexpr auto kSlice = 100ms;     // longest wait before a resized window is noticed

class Watch {
 public:
  Watch(const Context& context, const WatchOptions& options)
      : context_(context),
        options_(options),
        client_(connect(context, to_filter(options))),
        roster_(client_.scene(context.flags.timeout), options.bodies),
        revision_(client_.scene_revision()) {
    take(client_.report(context.flags.timeout));
    if (!options.json && stdout_is_terminal()) {
      screen_.emplace();
      if (options.rate == 0) pace_ = Pace(kTableRate);
    } else if (!options.json) {
      open_ = put(kPoseLinesTitle);
    }
  }

  ExitCode run() {
    while (!is_done()) {
      const bool came = client_.next_poses(poses_, kSlice);
      const auto now = Clock::now();
      if (came) {
        silent_since_ = now;
        meter_.add(now);
        if (!roster_.describes(poses_)) renew_roster();
        if (screen_) last_.complete(poses_);
        if (pace_.is_due(now)) show();
      } else {
        if (screen_) draw();
        check_silence(now - silent_since_);
      }
    }
    return ExitCode::ok;
  }

 private:
  bool is_done() const { return !open_ || (options_.count > 0 && shown_ >= options_.count); }

  void take(const RunReport& report) {
    frame_rate_ = report.frame_rate;
    state_ = name_of<RunState>(kRunStateNames, report.state);
  }

  void show() {
    if (screen_) {
      draw();
    } else {
      open_ = put(options_.json ? pose_json(poses_, roster_, frame_rate_)
                                : pose_lines(poses_, roster_, frame_rate_));
    }
    ++shown_;
  }

  void draw() {
    try {
      take(client_.report(0ns));
      if (client_.scene_revision() != revision_) renew_roster();  // removed bodies too
    } catch (const NoAnswer&) {                                   // no news
    }
    const WatchHeader header{.world = client_.world(),
                             .state = is_silent() ? "no frames (" + state_ + ")" : state_,
                             .frames_per_second = meter_.rate(Clock::now())};
    screen_->draw(pose_table(poses_, roster_, header, screen_->size()));
  }

  bool is_silent() const { return Clock::now() - silent_since_ > 1s; }

  // Spawned bodies, or a daemon that restarted with another scene. Throws Error if a wanted body is
  // gone.
  void renew_roster() {
    roster_ = Roster(client_.scene(context_.flags.timeout), options_.bodies);
    revision_ = client_.scene_revision();
    take(client_.report(context_.flags.timeout));
    context_.logger->info("scene_changed world={}", poinsot::quoted(client_.world()));
  }

  // A watch without end waits for the frames to come back; a counted one does not. Where only what
  // moves is sent, silence is as good as any frame.
  void check_silence(std::chrono::nanoseconds silence) {
    const std::chrono::duration<double> period(options_.rate > 0 ? 1 / options_.rate : 0);
    if (silence < context_.flags.timeout + 2 * period || options_.has_deadband) return;
    const std::string text = "no frame of world '" + client_.world() +
                             "' came: is it paused, or gone? See 'poinsot status'";
    if (options_.count > 0) throw NoAnswer(text);
    if (!screen_) context_.logger->warn("no_frames world={}", poinsot::quoted(client_.world()));
    silent_since_ = Clock::now();
  }

  const Context& context_;
  const WatchOptions& options_;
  Client client_;
  Roster roster_;
  Pace pace_{0};
  FrameMeter meter_;
  std::optional<LiveScreen> screen_;
  PoseSnapshot poses_;
  LastPoses last_;
  std::uint32_t revision_ = 0;  // of the scene that the roster is of
  double frame_rate_ = 0;       // [Hz]
  std::string state_;           // of the run
  Clock::time_point silent_since_ = Clock::now();
  std::uint64_t shown_ = 0;
  bool open_ = true;  // somebody reads
};

}  // namespace

PoseFilter to_filter(const WatchOptions& options) {
  PoseFilter filter;
  filter.match = options.match;
  filter.rate = options.rate;
  if (options.has_deadband) filter.change = options.deadband;
  return filter;
}

void LastPoses::complete(PoseSnapshot& poses) {
  const bool is_another_run =
      std::exchange(session_, poses.session) != poses.session || poses.epoch != epoch_;
  if (std::exchange(epoch_, poses.epoch), is_another_run || poses.complete) bodies_.clear();
  for (const BodyState& body : poses.bodies) bodies_[body.id] = body;
  poses.bodies.clear();
  for (const auto& [id, body] : bodies_) poses.bodies.push_back(body);
}

void add_watch_options(CLI::App& app, WatchOptions& options) {
  app.add_option("--body", options.bodies, "only this body; may be given several times")
      ->allow_extra_args(false)
      ->type_name("BODY");
  app.add_option("--match", options.match,
                 "only bodies whose names match, with * and ?; several with commas between")
      ->type_name("PATTERN");
  app.add_option("--rate", options.rate, "at most so many frames a second [all; the table: 10]")
      ->check(CLI::PositiveNumber)
      ->type_name("HZ");
  app.add_option("--deadband", options.deadband,
                 "[m, rad] only bodies that moved or turned by more since they were last sent")
      ->check(CLI::NonNegativeNumber)
      ->each([&options](const std::string&) { options.has_deadband = true; })
      ->type_name("X");
  app.add_option("-n,--count", options.count, "end after so many frames")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", options.json, "one JSON object per frame and line");
}

Action declare_watch(CLI::App& app) {
  const auto options = std::make_shared<WatchOptions>();
  add_watch_options(app, *options);
  return [options](const Context& context) { return Watch(context, *options).run(); };
}

}  // namespace poinsot
