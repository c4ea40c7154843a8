#include "poinsot/program/man_page.h"

#include <array>
#include <cctype>

#include "poinsot/program/exit_code.h"

namespace poinsot {
namespace {

constexpr std::array<EnvironmentRow, 4> kBusEnvironment = {{
    {"POINSOT_DOMAIN_ID", "DDS domain; --domain goes before it"},
    {"POINSOT_PARTITION", "DDS partition; --partition goes before it"},
    {"POINSOT_DISCOVERY_SERVER", "Fast DDS discovery server; --discovery-server goes before it"},
    {"FASTRTPS_DEFAULT_PROFILES_FILE",
     "Fast DDS profiles (XML), for what Poinsot does not set itself"},
}};

// Text as roff takes it: no character of it is a command.
std::string escaped(std::string_view text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string bold(std::string_view text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string synopsis(const std::string& program, const VerbEntry& verb) {
  std::string text = bold(program) + " " + bold(verb.name);
  if (!verb.options.empty()) text += " [" + italic("OPTIONS") + "]";
  for (const OptionEntry& positional : verb.positionals) {
    const std::string name =
        italic(positional.value.empty() ? upper(positional.names.front()) : positional.value);
    text += positional.required ? " " + name : " [" + name + "]";
  }
  return text;
}

std::string options(const std::vector<OptionEntry>& entries) {
  std::string text;
  for (const OptionEntry& option : entries) {
    text += ".TP\n";
    for (std::size_t i = 0; i < option.names.size(); ++i)
      text += (i > 0 ? ", " : "") + bold(option.names[i]);
    if (!option.value.empty()) text += " " + italic(option.value);
    text += "\n" + escaped(option.description) + "\n";
  }
  return text;
}

std::string verb_section(const std::string& program, const VerbEntry& verb) {
  std::string text = ".SS " + synopsis(program, verb) + "\n" + escaped(verb.summary) + ".\n";
  text += options(verb.positionals);
  text += options(verb.options);
  if (!verb.footer.empty()) text += ".PP\n.nf\n" + escaped(verb.footer) + "\n.fi\n";
  return text;
}

std::string exit_codes() {
  std::string text = ".SH \"EXIT STATUS\"\n";
  for (const ExitCodeRow& row : kExitCodes)
    text += ".TP\n" + bold(std::to_string(to_int(row.code))) + "\n" + escaped(row.meaning) + "\n";
  return text;
}

}  // namespace

std::span<const EnvironmentRow> bus_environment() {
  return kBusEnvironment;
}

std::string man_page(const CommandTree& tree, std::string_view see_also) {
  const std::string& name = tree.program.name;
  std::string text = ".TH " + upper(name) + " 1 \"\" \"Poinsot " POINSOT_VERSION "\" \"Poinsot\"\n";
  text += ".SH NAME\n" + escaped(name) + " \\- " + escaped(tree.program.summary) + "\n";
  text += ".SH SYNOPSIS\n";
  for (const VerbEntry& verb : tree.verbs) text += synopsis(name, verb) + "\n.br\n";
  text += ".SH OPTIONS\n" + options(tree.program.options);
  text += ".SH VERBS\n";
  for (const VerbEntry& verb : tree.verbs) text += verb_section(name, verb);
  text += ".SH ENVIRONMENT\n";
  for (const EnvironmentRow& row : kBusEnvironment)
    text += ".TP\n" + bold(row.name) + "\n" + escaped(row.meaning) + "\n";
  text += exit_codes();
  text += ".SH \"SEE ALSO\"\n" + escaped(see_also) + "\n";
  return text;
}

}  // namespace poinsot
