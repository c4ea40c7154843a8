#include "poinsot/cli/events.h"

#include <cstdio>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/roster.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

constexpr auto kSlice = 100ms;  // longest wait before a stop is noticed

class Events {
 public:
  Events(const Context& context, const EventsOptions& options)
      : context_(context),
        options_(options),
        client_(connect(context, &stop_)),
        roster_(client_.scene(context.flags.timeout), options.bodies) {
    if (!options.json) put(kImpactLinesTitle);
  }

  ExitCode run() {
    while (!stop_.wait_for(0ns) && !is_done())
      if (client_.next_impact(impact_, kSlice)) show();
    return ExitCode::ok;
  }

 private:
  bool is_done() const {
    return output_closed_ || (options_.count > 0 && shown_ >= options_.count);
  }

  void show() {
    if (impact_.session != roster_.session()) renew_roster();
    const std::string* const a = roster_.name(impact_.a.id);
    const std::string* const b = roster_.name(impact_.b.id);
    if (a == nullptr || b == nullptr) return;
    if (!roster_.shown(impact_.a.id) && !roster_.shown(impact_.b.id)) return;
    put(options_.json ? impact_json(impact_, *a, *b) : impact_line(impact_, *a, *b));
    ++shown_;
  }

  // A daemon that restarted with another scene: its report names it, its scene follows. Throws
  // Error if a wanted body is gone.
  void renew_roster() {
    client_.report(context_.flags.timeout);
    roster_ = Roster(client_.scene(context_.flags.timeout), options_.bodies);
    context_.logger->info("scene_changed world={}", poinsot::quoted(client_.world()));
  }

  void put(std::string_view text) {
    const bool written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    output_closed_ = !written;  // as by `| head`: nobody reads any more
  }

  StopSignals stop_;  // before the client, whose threads must not take the signals
  const Context& context_;
  const EventsOptions& options_;
  Client client_;
  Roster roster_;
  ImpactNotice impact_;
  std::uint64_t shown_ = 0;
  bool output_closed_ = false;
};

}  // namespace

void add_events_options(CLI::App& app, EventsOptions& options) {
  app.add_option("--body", options.bodies, "only its impacts; may be given several times")
      ->allow_extra_args(false)
      ->type_name("NAME");
  app.add_option("-n,--count", options.count, "end after so many impacts")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", options.json, "one JSON object per impact and line");
}

Action declare_events(CLI::App& app) {
  const auto options = std::make_shared<EventsOptions>();
  add_events_options(app, *options);
  return [options](const Context& context) { return Events(context, *options).run(); };
}

}  // namespace poinsot
