#include "poinsot/program/command_tree.h"

#include <algorithm>

namespace poinsot {
namespace {

// An option without a group is hidden: so CLI11 has it.
bool is_hidden(const CLI::Option& option) {
  return option.get_group().empty();
}

OptionEntry read_option(const CLI::Option& option) {
  OptionEntry entry;
  if (option.get_positional()) {
    entry.names = {option.get_name(true, false)};
  } else {
    for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  }
  if (option.get_type_size() != 0) {
    const std::string type = option.get_type_name();  // the checks' names come after a colon
    entry.value = type.substr(0, type.find(':'));
  }
  entry.description = option.get_description();
  entry.required = option.get_required();
  return entry;
}

VerbEntry read_verb(const CLI::App& app) {
  VerbEntry entry;
  entry.name = app.get_name();
  entry.summary = app.get_description();
  entry.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (is_hidden(*option)) continue;
    (option->get_positional() ? entry.positionals : entry.options).push_back(read_option(*option));
  }
  return entry;
}

}  // namespace

CommandTree read_tree(const CLI::App& app) {
  CommandTree tree;
  tree.program = read_verb(app);
  for (const CLI::App* verb : app.get_subcommands({}))
    if (!verb->get_group().empty()) tree.verbs.push_back(read_verb(*verb));
  return tree;
}

std::vector<std::string> choices(const OptionEntry& option) {
  std::vector<std::string> words;
  if (option.value.find('|') == std::string::npos) return words;
  std::size_t start = 0;
  while (start <= option.value.size()) {
    const std::size_t end = std::min(option.value.find('|', start), option.value.size());
    words.push_back(option.value.substr(start, end - start));
    start = end + 1;
  }
  return words;
}

}  // namespace poinsot
