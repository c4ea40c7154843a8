#include "poinsot/cli/list.h"

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"

namespace poinsot {
namespace {

struct ListOptions {
  bool json = false;
  bool names = false;
  bool worlds = false;
};

// One daemon. Throws NoAnswer if it is gone by now.
void print(const Context& context, const std::string& world, bool json) {
  Context here = context;
  here.flags.world = world;
  Client client = connect(here);
  const RunReport report = client.report(here.flags.timeout);
  const std::vector<BodyInfo> bodies = client.scene(here.flags.timeout);
  put(json ? list_json(world, report, bodies) : list_text(world, report, bodies));
}

// What a shell completes with: a line per name, of the one world there is or that is named.
void print_names(const Context& context) {
  Client client = connect(context);
  std::string text;
  for (const BodyInfo& body : client.scene(context.flags.timeout)) text += body.name + "\n";
  put(text);
}

ExitCode list(const Context& context, const ListOptions& options) {
  if (options.names) {
    print_names(context);
    return ExitCode::ok;
  }
  std::vector<std::string> worlds = {context.flags.world};
  if (context.flags.world.empty()) worlds = wait_for_worlds(context);
  for (const std::string& world : worlds) {
    if (options.worlds)
      put(world + "\n");
    else
      print(context, world, options.json);
  }
  return ExitCode::ok;
}

}  // namespace

Action declare_list(CLI::App& app) {
  const auto options = std::make_shared<ListOptions>();
  CLI::Option* const json =
      app.add_flag("--json", options->json, "one JSON object per daemon and line");
  CLI::Option* const names =
      app.add_flag("--names", options->names, "only the names of the bodies of one world");
  app.add_flag("--worlds", options->worlds, "only the names of the worlds")
      ->excludes(names)
      ->excludes(json);
  names->excludes(json);
  return [options](const Context& context) { return list(context, *options); };
}

}  // namespace poinsot
