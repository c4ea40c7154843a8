#include "poinsot/program/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ostream>

#include "poinsot/base/error.h"
#include "poinsot/program/exit_code.h"
#include "poinsot/program/parse.h"

namespace poinsot {
namespace {

constexpr int kMaxDomain = 232;  // of the DDS port mapping

// The faulty value may stand in the environment, so the message names both places.
std::string check_domain(const std::string& text) {
  int domain = -1;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, domain);
  if (error == std::errc() && end == last && domain >= 0 && domain <= kMaxDomain) return {};
  return "'" + text +
         "' (option or environment variable POINSOT_DOMAIN_ID) is not a DDS domain: "
         "a whole number from 0 to " +
         std::to_string(kMaxDomain);
}

std::string check_server(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  int port = 0;
  if (colon != std::string::npos && colon > 0) {
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + colon + 1, last, port);
    if (error == std::errc() && end == last && port >= 1 && port <= 65535) return {};
  }
  return "'" + text +
         "' (option or environment variable POINSOT_DISCOVERY_SERVER) is not ADDRESS:PORT, like "
         "127.0.0.1:11811";
}

constexpr std::array<Named<bool>, 2> kReachNames = {{{"local", false}, {"lan", true}}};

class PlainFormatter : public CLI::Formatter {
 public:
  PlainFormatter() { label("SUBCOMMAND", "VERB"); }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return {};  // a flag
    const std::string type = option->get_type_name();
    return " " + type.substr(0, type.find(':'));  // the checks' names come after a colon
  }
};

// The verb that the command line got to, or the program itself.
const CLI::App* deepest(const CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().back();
  return app;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return did_you_mean(word, views);
}

std::string unknown_word(const CLI::App& app, const std::vector<std::string>& words) {
  const auto option = std::find_if(words.begin(), words.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (option != words.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "unknown option '" + name + "'" + suggestion(name, option_names(app));
  }
  const std::vector<std::string> verbs = verb_names(app);
  if (verbs.empty()) return "unexpected argument '" + words.front() + "'";
  return "unknown verb '" + words.front() + "'" + suggestion(words.front(), verbs);
}

std::string fault(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& verb = *deepest(&app);
  const bool may_hide_a_typo = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                               dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const std::vector<std::string> words = app.remaining(true);
  if (may_hide_a_typo && !words.empty()) return unknown_word(verb, words);
  const std::vector<std::string> verbs = verb_names(verb);
  if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr || verbs.empty())
    return error.what();
  std::string text = "no verb given: one of";
  for (const std::string& name : verbs) text += " " + name;
  return text;
}

std::string full_name(const CLI::App& app) {
  const CLI::App* const verb = deepest(&app);
  return verb == &app ? app.get_name() : app.get_name() + " " + verb->get_name();
}

template <class Value>
CLI::Option* add_parsed(CLI::App& app, const std::string& name, Value& value,
                        Value (*parse)(std::string_view), const std::string& description) {
  const auto read = [&value, name, parse](const std::string& text) {
    try {
      value = parse(text);
    } catch (const Error& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return app.add_option_function<std::string>(name, read, description);
}

}  // namespace

std::string joined(std::span<const std::string_view> names, std::string_view separator) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += separator;
    text += name;
  }
  return text;
}

std::string unknown_choice(std::string_view word, std::span<const std::string_view> names) {
  return "'" + std::string(word) + "' is not one of " + joined(names, ", ") +
         did_you_mean(word, names);
}

void add_bus_options(CLI::App& app, BusFlags& flags) {
  app.add_option("--domain", flags.domain,
                 "DDS domain, 0 to 232 [environment variable POINSOT_DOMAIN_ID, or 77]")
      ->check(CLI::Validator(check_domain, "", "domain"))
      ->envname("POINSOT_DOMAIN_ID")
      ->type_name("N");
  add_choice_option<bool>(app, "--listen", flags.lan, kReachNames,
                          "whom to talk to: this host only, or the local network [local]");
  app.add_option("--partition", flags.partition,
                 "only participants of the same DDS partition [environment variable "
                 "POINSOT_PARTITION, or none]")
      ->envname("POINSOT_PARTITION")
      ->type_name("NAME");
  app.add_option(
         "--discovery-server", flags.discovery_server,
         "meet others at this Fast DDS discovery server, ADDRESS:PORT, instead of by greeting "
         "[environment variable POINSOT_DISCOVERY_SERVER]")
      ->check(CLI::Validator(check_server, "", "server"))
      ->envname("POINSOT_DISCOVERY_SERVER")
      ->type_name("SERVER");
}

void add_verbose_option(CLI::App& app, int& verbosity) {
  app.add_flag_function(
      "-v,--verbose", [&verbosity](std::int64_t count) { verbosity = static_cast<int>(count); },
      "log more; twice: all");
}

std::string_view program_version() {
  return POINSOT_VERSION;
}

void add_version_option(CLI::App& app) {
  app.set_version_flag("--version", app.get_name() + " " POINSOT_VERSION, "print the version");
}

void set_plain_help(CLI::App& app) {
  app.formatter(std::make_shared<PlainFormatter>());
}

CLI::Option* add_vector_option(CLI::App& app, const std::string& name, Eigen::Vector3d& value,
                               const std::string& description) {
  return add_parsed(app, name, value, parse_vector, description)->type_name("X,Y,Z");
}

CLI::Option* add_orientation_option(CLI::App& app, const std::string& name,
                                    Eigen::Quaterniond& value, const std::string& description) {
  return add_parsed(app, name, value, parse_orientation, description)->type_name("X,Y,Z,W");
}

CLI::Option* add_duration_option(CLI::App& app, const std::string& name,
                                 std::chrono::nanoseconds& value, const std::string& description) {
  return add_parsed(app, name, value, parse_duration, description)->type_name("TIME");
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      std::ostream& out, std::ostream& err) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help or version was asked for
      app.exit(error, out, err);
      return to_int(ExitCode::ok);
    }
    err << app.get_name() << ": " << fault(app, error) << "\nTry '" << full_name(app)
        << " --help'.\n";
    return to_int(ExitCode::usage);
  }
}

}  // namespace poinsot
