#include "poinsot/cli/doctor.h"

#include "poinsot/cli/bus_checks.h"
#include "poinsot/cli/connect.h"
#include "poinsot/cli/findings.h"
#include "poinsot/cli/host_checks.h"
#include "poinsot/cli/output.h"
#include "poinsot/wire/diagnosis.h"

namespace poinsot {
namespace {

struct DoctorOptions {
  bool json = false;
  std::string peer;
};

Finding versions() {
  return {Health::ok,
          "versions",
          "poinsot " + std::string(program_version()) + ", " + bus_library(),
          {}};
}

ExitCode examine(const Context& context, const DoctorOptions& options) {
  if (!options.peer.empty()) return be_peer(context, options.peer);
  Findings all;
  const auto tell = [&](const Findings& findings) {
    for (const Finding& finding : findings) {
      if (!options.json) put(finding_text(finding));
      all.push_back(finding);
    }
  };
  route_log(context.logger);
  const BusFlags& flags = context.flags.bus;
  tell({versions(), check_domain_choice(flags)});
  tell(check_interfaces(flags));
  tell(check_ports(flags.domain));
  tell(check_shared_memory());
  tell({check_socket_buffers()});
  tell({check_profiles()});
  const Finding meeting = check_meeting(context);
  tell({meeting});
  if (meeting.health != Health::fail) tell(check_worlds(context));
  if (options.json) put(findings_json(all));
  return has_failed(all) ? ExitCode::failure : ExitCode::ok;
}

}  // namespace

Action declare_doctor(CLI::App& app) {
  const auto options = std::make_shared<DoctorOptions>();
  app.add_flag("--json", options->json, "print one JSON object");
  app.add_option("--peer", options->peer)->group("");  // hidden: see bus_checks.h
  return [options](const Context& context) { return examine(context, *options); };
}

}  // namespace poinsot
