#include "poinsot/cli/send.h"

#include <cstdio>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"

namespace poinsot {
namespace {

ExitCode refuse(std::string_view what, const Reply& reply) {
  std::fputs(refusal_text(what, reply).c_str(), stderr);
  return ExitCode::failure;
}

}  // namespace

ExitCode send(const Context& context, Client& client, WrenchCommand command, std::string_view verb,
              bool json) {
  command.outlives_client = true;  // the tool is gone as soon as it has the answer
  const RunReport report = client.report(context.flags.timeout);
  const Reply reply = client.apply(command, context.flags.timeout);
  if (json) put(push_json(command, reply, report.frame_rate));
  if (reply.code != ResultCode::ok) return refuse(verb, reply);
  if (!json) put(push_text(command, reply, report.frame_rate));
  if (report.state == RunState::paused && command.hold != Hold::clear)
    std::fputs("the run is paused: the push acts when it goes on (poinsot resume, poinsot step)\n",
               stderr);
  return ExitCode::ok;
}

ExitCode send(const Context& context, const WrenchCommand& command, std::string_view verb,
              bool json) {
  Client client = connect(context);
  return send(context, client, command, verb, json);
}

ExitCode send(const Context& context, const RunControl& control, bool json) {
  Client client = connect(context);
  const double frame_rate = client.report(context.flags.timeout).frame_rate;
  const std::string_view action = name_of<ControlAction>(kControlActionNames, control.action);
  const Reply reply = client.control(control, context.flags.timeout);
  if (json) put(control_json(action, reply, frame_rate));
  if (reply.code != ResultCode::ok) return refuse(action, reply);
  if (!json) put(control_text(action, reply, frame_rate));
  return ExitCode::ok;
}

}  // namespace poinsot
