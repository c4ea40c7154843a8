#include "poinsot/cli/status.h"

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"

namespace poinsot {
namespace {

// For their names; a status without them is better than none.
std::vector<BodyInfo> bodies(Client& client, Client::Duration timeout) {
  try {
    return client.scene(timeout);
  } catch (const NoAnswer&) {
    return {};
  }
}

}  // namespace

Action declare_status(CLI::App& app) {
  const auto json = std::make_shared<bool>(false);
  app.add_flag("--json", *json, "print one JSON object");
  return [json](const Context& context) {
    Client client = connect(context);
    const RunReport report = client.report(context.flags.timeout);
    const std::string text =
        *json ? status_json(client.world(), report, bodies(client, context.flags.timeout))
              : status_text(client.world(), report);
    put(text);
    return ExitCode::ok;
  };
}

}  // namespace poinsot
