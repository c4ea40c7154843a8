#include "poinsot/cli/events.h"

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"
#include "poinsot/cli/roster.h"

namespace poinsot {
namespace {

class Events {
 public:
  Events(const Context& context, const EventsOptions& options)
      : context_(context),
        options_(options),
        client_(connect_to_listen(context)),
        roster_(client_.scene(context.flags.timeout), options.bodies) {}

  ExitCode run() {
    if (!options_.json) open_ = put(kImpactLinesTitle);
    while (open_ && (options_.count == 0 || shown_ < options_.count))
      if (client_.next_impact(impact_, context_.flags.timeout)) show();
    return ExitCode::ok;
  }

 private:
  void show() {
    if (!knows(impact_)) renew_roster();
    const std::string* const a = roster_.name(impact_.a.id);
    const std::string* const b = roster_.name(impact_.b.id);
    if (a == nullptr || b == nullptr) return;  // removed since
    if (!roster_.shown(impact_.a.id) && !roster_.shown(impact_.b.id)) return;
    open_ = put(options_.json ? impact_json(impact_, *a, *b) : impact_line(impact_, *a, *b));
    ++shown_;
  }

  bool knows(const ImpactNotice& impact) const {
    return impact.session == roster_.session() && roster_.name(impact.a.id) != nullptr &&
           roster_.name(impact.b.id) != nullptr;
  }

  // Spawned bodies, or a daemon that restarted with another scene: its report names it, its scene
  // follows. Throws Error if a wanted body is gone.
  void renew_roster() {
    client_.report(context_.flags.timeout);
    roster_ = Roster(client_.scene(context_.flags.timeout), options_.bodies);
    context_.logger->info("scene_changed world={}", poinsot::quoted(client_.world()));
  }

  const Context& context_;
  const EventsOptions& options_;
  Client client_;
  Roster roster_;
  ImpactNotice impact_;
  std::uint64_t shown_ = 0;
  bool open_ = true;  // somebody reads
};

}  // namespace

void add_events_options(CLI::App& app, EventsOptions& options) {
  app.add_option("--body", options.bodies, "only its impacts; may be given several times")
      ->allow_extra_args(false)
      ->type_name("BODY");
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
