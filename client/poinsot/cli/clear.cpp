#include "poinsot/cli/clear.h"

#include <charconv>

#include "poinsot/base/error.h"
#include "poinsot/cli/connect.h"
#include "poinsot/cli/held.h"
#include "poinsot/cli/output.h"
#include "poinsot/cli/send.h"

namespace poinsot {
namespace {

std::uint64_t client_number(const std::string& text) {
  std::uint64_t number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number, 16);
  if (error != std::errc() || end != last || number == 0)
    throw Error("--client: '" + text + "' is not a client as 'poinsot pushes' shows it");
  return number;
}

// What this user or, if it is named, another client holds.
Client connect_as(const Context& context, const std::string& client) {
  ClientOptions options = client_options(context);
  if (!client.empty()) options.client = client_number(client);
  return connect(context, options);
}

}  // namespace

void add_clear_options(CLI::App& app, ClearOptions& options) {
  app.add_option("body", options.body, "on this body only [all bodies]")->type_name("BODY");
  app.add_option("--slot", options.slot, "in this slot only")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_option("--client", options.client,
                 "what this client holds, that left something behind (see poinsot pushes) [you]")
      ->type_name("ID");
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

WrenchCommand to_command(const ClearOptions& options) {
  WrenchCommand command;
  command.body_name = options.body;
  command.slot = options.slot;
  command.hold = Hold::clear;
  return command;
}

Action declare_clear(CLI::App& app) {
  const auto options = std::make_shared<ClearOptions>();
  add_clear_options(app, *options);
  return [options](const Context& context) {
    Client client = connect_as(context, options->client);
    return send(context, client, to_command(*options), "clear", options->json);
  };
}

Action declare_pushes(CLI::App& app) {
  const auto json = std::make_shared<bool>(false);
  app.add_flag("--json", *json, "print one JSON object");
  return [json](const Context& context) {
    Client client = connect(context);
    const RunReport report = client.report(context.flags.timeout);
    const HeldList held = client.held(context.flags.timeout);
    const Roster roster(client.scene(context.flags.timeout), {});
    const HeldView view{held, roster, client.id(), report.frame_rate};
    put(*json ? held_json(view) : held_text(view));
    return ExitCode::ok;
  };
}

}  // namespace poinsot
