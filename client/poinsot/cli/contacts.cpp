#include "poinsot/cli/contacts.h"

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/cli/output.h"
#include "poinsot/cli/roster.h"

namespace poinsot {
namespace {

bool describes(const Roster& roster, const ContactSnapshot& contacts) {
  if (contacts.session != roster.session()) return false;
  for (const ContactState& contact : contacts.contacts)
    if (roster.name(contact.a) == nullptr || roster.name(contact.b) == nullptr) return false;
  return true;
}

ExitCode show_contacts(const Context& context, const ContactsOptions& options) {
  Client client = connect_to_listen(context);
  Roster roster(client.scene(context.flags.timeout), options.bodies);
  double frame_rate = client.report(context.flags.timeout).frame_rate;
  if (!options.json && !put(kContactLinesTitle)) return ExitCode::ok;
  ContactSnapshot contacts;
  for (std::uint64_t shown = 0; options.count == 0 || shown < options.count; ++shown) {
    while (!client.next_contacts(contacts, context.flags.timeout)) {
      if (options.count > 0)
        throw NoAnswer("no frame of world '" + client.world() +
                       "' came: is it paused, or gone? See 'poinsot status'");
    }
    if (!describes(roster, contacts)) {  // spawned bodies, or a daemon that was started again
      frame_rate = client.report(context.flags.timeout).frame_rate;
      roster = Roster(client.scene(context.flags.timeout), options.bodies);
    }
    const std::string text = options.json ? contacts_json(contacts, roster, frame_rate)
                                          : contact_lines(contacts, roster, frame_rate);
    if (!put(text)) break;
  }
  return ExitCode::ok;
}

}  // namespace

void add_contacts_options(CLI::App& app, ContactsOptions& options) {
  app.add_option("--body", options.bodies, "only its contacts; may be given several times")
      ->allow_extra_args(false)
      ->type_name("BODY");
  app.add_option("-n,--count", options.count, "end after so many frames")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", options.json, "one JSON object per frame and line");
}

Action declare_contacts(CLI::App& app) {
  const auto options = std::make_shared<ContactsOptions>();
  add_contacts_options(app, *options);
  return [options](const Context& context) { return show_contacts(context, *options); };
}

}  // namespace poinsot
