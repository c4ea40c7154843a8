#include "poinsot/cli/delay.h"

#include <algorithm>
#include <stdexcept>

#include <spdlog/fmt/fmt.h>

#include "poinsot/base/error.h"
#include "poinsot/cli/connect.h"
#include "poinsot/cli/json_line.h"
#include "poinsot/cli/output.h"
#include "poinsot/cli/roster.h"
#include "poinsot/cli/spread.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kInterval = 1s;      // of a line
constexpr double kPushSpeed = 0.5;  // [m/s] that a push adds, to and fro along x
// Of that, what must be seen from one frame to the next: friction takes some of it.
constexpr double kSeenShare = 0.2;
constexpr auto kLongestWait = 5s;  // for a push to be seen
constexpr double kMs = 1e3;

double age_of(const PoseSnapshot& poses) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now - std::chrono::nanoseconds(poses.publish_time_ns))
      .count();
}

// Calls `work` until it says no; a stop ends it too, so that a summary can follow.
template <class Work>
void until_stopped(Work work) {
  try {
    while (work()) {
    }
  } catch (const Stopped&) {
  }
}

ExitCode show_ages(const Context& context, const DelayOptions& options) {
  Client client = connect(context, PoseFilter{});
  std::vector<double> all, recent;
  PoseSnapshot poses;
  auto line_at = Clock::now() + kInterval;
  until_stopped([&] {
    if (client.next_poses(poses, 100ms)) {
      recent.push_back(age_of(poses));
      all.push_back(recent.back());
    }
    if (!options.json && Clock::now() >= line_at) {
      line_at += kInterval;
      if (!put(age_text(std::exchange(recent, {})))) return false;
    }
    return options.count == 0 || all.size() < options.count;
  });
  put(options.json ? age_json(all) : "all: " + age_text(all));
  return ExitCode::ok;
}

// Pushes a body to and fro, and looks for each push in the stream of poses.
class PushMeter {
 public:
  PushMeter(const Context& context, const DelayOptions& options)
      : timeout_(context.flags.timeout), client_(connect(context, PoseFilter{})) {
    const std::vector<BodyInfo> bodies = client_.scene(timeout_);
    const Roster roster(bodies, {options.body});  // throws for an unknown or static body
    body_ = *std::find_if(bodies.begin(), bodies.end(),
                          [&](const BodyInfo& info) { return info.name == options.body; });
  }

  SeenPush push() {
    double speed = newest_speed();
    const std::uint64_t before = poses_.frame;
    const double change = std::exchange(next_change_, -next_change_);
    const auto start = Clock::now();
    send(change);
    while (Clock::now() < start + kLongestWait) {
      if (!client_.next_poses(poses_, 100ms)) continue;
      const double last = std::exchange(speed, speed_in(poses_));
      if ((speed - last) / change < kSeenShare) continue;
      return {static_cast<double>(poses_.frame - before),
              std::chrono::duration<double>(Clock::now() - start).count()};
    }
    throw std::runtime_error("the push was not seen: is the run paused, or the body held?");
  }

 private:
  double newest_speed() {
    while (client_.latest_poses(poses_)) {
    }
    if (!client_.next_poses(poses_, timeout_)) throw NoAnswer("no frame came: is the run paused?");
    return speed_in(poses_);
  }

  double speed_in(const PoseSnapshot& poses) const {
    for (const BodyState& body : poses.bodies)
      if (body.id == body_.id) return body.linear_velocity.x();
    throw std::runtime_error("body '" + body_.name + "' is gone");
  }

  void send(double change) {
    WrenchCommand command;
    command.body = body_.id;
    command.kind = WrenchKind::impulse;
    command.force = {body_.mass_properties.mass * change, 0, 0};
    const Reply reply = client_.apply(command, timeout_);
    if (reply.code != ResultCode::ok) throw std::runtime_error("push refused: " + reply.message);
  }

  Client::Duration timeout_;
  Client client_;
  BodyInfo body_;
  PoseSnapshot poses_;
  double next_change_ = kPushSpeed;
};

ExitCode show_pushes(const Context& context, const DelayOptions& options) {
  PushMeter meter(context, options);
  std::vector<SeenPush> pushes;
  until_stopped([&] {
    pushes.push_back(meter.push());
    const bool open = options.json || put(seen_text({pushes.back()}));
    return open && (options.count == 0 || pushes.size() < options.count);
  });
  put(options.json ? seen_json(pushes) : "all: " + seen_text(pushes));
  return ExitCode::ok;
}

std::vector<double> column(const std::vector<SeenPush>& pushes, double SeenPush::*value) {
  std::vector<double> values;
  for (const SeenPush& push : pushes) values.push_back(push.*value);
  return values;
}

std::string spread_text(const Spread& spread, double scale) {
  return fmt::format("p50 {:.3g}, p99 {:.3g}, max {:.3g}", spread.p50 * scale, spread.p99 * scale,
                     spread.max * scale);
}

Json spread_json(const Spread& spread) {
  return {{"p50", spread.p50}, {"p99", spread.p99}, {"max", spread.max}};
}

}  // namespace

std::string age_text(const std::vector<double>& ages) {
  if (ages.empty()) return "no frame came\n";
  return fmt::format("{} frames, published to received: {} ms\n", ages.size(),
                     spread_text(spread_of(ages), kMs));
}

std::string age_json(const std::vector<double>& ages) {
  return json_line({{"frames", ages.size()}, {"age", spread_json(spread_of(ages))}});
}

std::string seen_text(const std::vector<SeenPush>& pushes) {
  if (pushes.empty()) return "no push was seen\n";
  const Spread frames = spread_of(column(pushes, &SeenPush::frames));
  const Spread seconds = spread_of(column(pushes, &SeenPush::seconds));
  if (pushes.size() == 1)
    return fmt::format("seen {:g} frames after the newest one when it was sent, {:.3g} ms\n",
                       frames.max, seconds.max * kMs);
  return fmt::format("{} pushes, sent to seen: {} frames; {} ms\n", pushes.size(),
                     spread_text(frames, 1), spread_text(seconds, kMs));
}

std::string seen_json(const std::vector<SeenPush>& pushes) {
  return json_line({{"pushes", pushes.size()},
                    {"frames", spread_json(spread_of(column(pushes, &SeenPush::frames)))},
                    {"seconds", spread_json(spread_of(column(pushes, &SeenPush::seconds)))}});
}

void add_delay_options(CLI::App& app, DelayOptions& options) {
  app.add_option("--push", options.body,
                 "push this body to and fro instead, by 0.5 m/s, and wait for it to be seen")
      ->type_name("BODY");
  app.add_option("-n,--count", options.count, "end after so many frames or pushes")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", options.json, "only the summary, as a JSON object [s]");
}

Action declare_delay(CLI::App& app) {
  const auto options = std::make_shared<DelayOptions>();
  add_delay_options(app, *options);
  return [options](const Context& context) {
    return options->body.empty() ? show_ages(context, *options) : show_pushes(context, *options);
  };
}

}  // namespace poinsot
