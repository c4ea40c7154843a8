#include "poinsot/cli/list.h"

#include <cstdio>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"

namespace poinsot {
namespace {

// One daemon. Throws NoAnswer if it is gone by now.
void print(const Context& context, const std::string& world, bool json) {
  Context here = context;
  here.flags.world = world;
  Client client = connect(here);
  const RunReport report = client.report(here.flags.timeout);
  const std::vector<BodyInfo> bodies = client.scene(here.flags.timeout);
  const std::string text =
      json ? list_json(world, report, bodies) : list_text(world, report, bodies);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

Action declare_list(CLI::App& app) {
  const auto json = std::make_shared<bool>(false);
  app.add_flag("--json", *json, "one JSON object per daemon and line");
  return [json](const Context& context) {
    std::vector<std::string> worlds = {context.flags.world};
    if (context.flags.world.empty()) worlds = wait_for_worlds(context);
    for (const std::string& world : worlds) print(context, world, *json);
    return ExitCode::ok;
  };
}

}  // namespace poinsot
