#include "poinsot/cli/watch.h"

#include <cstdio>
#include <optional>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/pace.h"
#include "poinsot/cli/terminal.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double kTableRate = 10;  // [Hz] what an eye can follow
constexpr auto kSlice = 100ms;     // longest wait before a stop or a resized window is noticed

class Watch {
 public:
  Watch(const Context& context, const WatchOptions& options)
      : context_(context),
        options_(options),
        client_(connect(context, &stop_)),
        roster_(client_.scene(context.flags.timeout), options.bodies),
        pace_(options.rate) {
    take(client_.report(context.flags.timeout));
    if (!options.json && stdout_is_terminal()) {
      screen_.emplace();
      if (options.rate == 0) pace_ = Pace(kTableRate);
    } else if (!options.json) {
      put(kPoseLinesTitle);
    }
  }

  ExitCode run() {
    while (!stop_.wait_for(0ns) && !is_done()) {
      const bool came = client_.next_poses(poses_, kSlice);
      const auto now = Clock::now();
      if (came) {
        silent_since_ = now;
        meter_.add(now);
        if (!roster_.describes(poses_)) renew_roster();
        if (pace_.is_due(now)) show();
      } else {
        if (screen_) draw();
        check_silence(now - silent_since_);
      }
    }
    return ExitCode::ok;
  }

 private:
  bool is_done() const {
    return output_closed_ || (options_.count > 0 && shown_ >= options_.count);
  }

  void take(const RunReport& report) {
    frame_rate_ = report.frame_rate;
    state_ = name_of<RunState>(kRunStateNames, report.state);
  }

  void show() {
    if (screen_) {
      draw();
    } else {
      put(options_.json ? pose_json(poses_, roster_, frame_rate_)
                        : pose_lines(poses_, roster_, frame_rate_));
    }
    ++shown_;
  }

  void draw() {
    try {
      take(client_.report(0ns));
    } catch (const NoAnswer&) {  // no news
    }
    const WatchHeader header{.world = client_.world(),
                             .state = is_silent() ? "no frames (" + state_ + ")" : state_,
                             .frames_per_second = meter_.rate(Clock::now())};
    screen_->draw(pose_table(poses_, roster_, header, screen_->size()));
  }

  bool is_silent() const { return Clock::now() - silent_since_ > 1s; }

  // A daemon that restarted with another scene. Throws Error if a wanted body is gone.
  void renew_roster() {
    roster_ = Roster(client_.scene(context_.flags.timeout), options_.bodies);
    take(client_.report(context_.flags.timeout));
    context_.logger->info("scene_changed world={}", poinsot::quoted(client_.world()));
  }

  // A watch without end waits for the frames to come back; a counted one does not.
  void check_silence(std::chrono::nanoseconds silence) {
    if (silence < context_.flags.timeout) return;
    const std::string text = "no frame of world '" + client_.world() +
                             "' came: is it paused, or gone? See 'poinsot status'";
    if (options_.count > 0) throw NoAnswer(text);
    if (!screen_) context_.logger->warn("no_frames world={}", poinsot::quoted(client_.world()));
    silent_since_ = Clock::now();
  }

  void put(std::string_view text) {
    const bool written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    output_closed_ = !written;  // as by `| head`: nobody reads any more
  }

  StopSignals stop_;  // before the client, whose threads must not take the signals
  const Context& context_;
  const WatchOptions& options_;
  Client client_;
  Roster roster_;
  Pace pace_;
  FrameMeter meter_;
  std::optional<LiveScreen> screen_;
  PoseSnapshot poses_;
  double frame_rate_ = 0;  // [Hz]
  std::string state_;      // of the run
  Clock::time_point silent_since_ = Clock::now();
  std::uint64_t shown_ = 0;
  bool output_closed_ = false;
};

}  // namespace

void add_watch_options(CLI::App& app, WatchOptions& options) {
  app.add_option("--body", options.bodies, "only this body; may be given several times")
      ->allow_extra_args(false)
      ->type_name("NAME");
  app.add_option("--rate", options.rate, "at most so many frames a second [all; the table: 10]")
      ->check(CLI::PositiveNumber)
      ->type_name("HZ");
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
