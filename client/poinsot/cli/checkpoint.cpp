#include "poinsot/cli/checkpoint.h"

#include <string>

#include "poinsot/cli/control.h"
#include "poinsot/cli/send.h"

namespace poinsot {
namespace {

// On the bus an empty name stands for it.
constexpr std::string_view kLatest = "latest";

}  // namespace

Action declare_save(CLI::App& app) {
  const auto options = std::make_shared<ControlOptions>();
  options->control.action = ControlAction::save;
  app.add_option("name", options->control.name, "what to call it [one is found]")
      ->type_name("NAME");
  app.add_flag("--disk", options->control.on_disk,
               "on the daemon's disk too, where it outlives the daemon");
  app.add_flag("--json", options->json, "print the answer as a JSON object");
  return
      [options](const Context& context) { return send(context, options->control, options->json); };
}

Action declare_restore(CLI::App& app) {
  const auto options = std::make_shared<ControlOptions>();
  options->control.action = ControlAction::restore;
  app.add_option("name", options->control.name, "which one [latest]")->type_name("NAME");
  app.add_flag("--json", options->json, "print the answer as a JSON object");
  return [options](const Context& context) {
    RunControl control = options->control;
    if (control.name == kLatest) control.name.clear();
    return send(context, control, options->json);
  };
}

}  // namespace poinsot
