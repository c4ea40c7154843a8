#include "poinsot/program/completion.h"

#include <string_view>

namespace poinsot {
namespace {

enum class Source { nothing, words, bodies, worlds, files };

Source source_of(const OptionEntry& option) {
  if (!choices(option).empty()) return Source::words;
  if (option.value == "BODY") return Source::bodies;
  if (option.value == "WORLD") return Source::worlds;
  if (option.value == "FILE" || option.value == "SCENE") return Source::files;
  return Source::nothing;
}

// `text` between single quotes of a shell.
std::string shell_word(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : separator).append(word);
  return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

std::vector<std::string> option_names(const VerbEntry& verb) {
  std::vector<std::string> names;
  for (const OptionEntry& option : verb.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// Bash ------------------------------------------------------------------------------------------

std::string bash_offer(const OptionEntry& option) {
  switch (source_of(option)) {
    case Source::words:
      return "_PROGRAM_offer " + shell_word(joined(choices(option), "\n"));
    case Source::bodies:
      return "_PROGRAM_offer \"$(_PROGRAM_ask --names)\"";
    case Source::worlds:
      return "_PROGRAM_offer \"$(_PROGRAM_ask --worlds)\"";
    case Source::files:
      return "_PROGRAM_files";
    case Source::nothing:
      return ":";
  }
  return ":";
}

constexpr std::string_view kBashHelpers =
    R"sh(_PROGRAM_offer() {  # lines that begin with the word typed
  local word
  while IFS= read -r word; do
    [[ -n $word && $word == "$cur"* ]] && COMPREPLY+=("$(printf %q "$word")")
  done <<< "$1"
}
_PROGRAM_files() {
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$cur")
}
_PROGRAM_ask() {  # the daemons on the bus that the line names
  local i
  local -a bus=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
      --world | --domain | --listen | --partition) bus+=("${COMP_WORDS[i]}" "${COMP_WORDS[i + 1]}") ;;
    esac
  done
  command poinsot list "$1" --timeout 1s "${bus[@]}" 2> /dev/null
}
)sh";

std::string bash_verb(const VerbEntry& verb) {
  std::string text = "    " + verb.name + ")\n      case $prev in\n";
  for (const OptionEntry& option : verb.options)
    if (!option.value.empty())
      text +=
          "        " + joined(option.names, " | ") + ") " + bash_offer(option) + "; return ;;\n";
  text += "      esac\n";
  if (!verb.positionals.empty())
    text += "      [[ $cur == -* ]] || { " + bash_offer(verb.positionals.front()) + "; return; }\n";
  text += "      _PROGRAM_offer " + shell_word(joined(option_names(verb), "\n")) + " ;;\n";
  return text;
}

std::string bash_script(const CommandTree& tree) {
  std::vector<std::string> first;
  for (const VerbEntry& verb : tree.verbs) first.push_back(verb.name);
  for (const std::string& name : option_names(tree.program)) first.push_back(name);
  std::string text = "# Completion of PROGRAM for bash.\n";
  text += kBashHelpers;
  text +=
      "_PROGRAM() {\n  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n    _PROGRAM_offer " +
      shell_word(joined(first, "\n")) + "\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n";
  for (const VerbEntry& verb : tree.verbs) text += bash_verb(verb);
  text += "  esac\n}\ncomplete -F _PROGRAM PROGRAM\n";
  return replaced(text, "PROGRAM", tree.program.name);
}

// Zsh -------------------------------------------------------------------------------------------

std::string zsh_action(const OptionEntry& option) {
  switch (source_of(option)) {
    case Source::words:
      return "(" + joined(choices(option), " ") + ")";
    case Source::bodies:
      return "_PROGRAM_bodies";
    case Source::worlds:
      return "_PROGRAM_worlds";
    case Source::files:
      return "_files";
    case Source::nothing:
      return "";
  }
  return "";
}

// A text within a specification of _arguments or _describe.
std::string zsh_text(std::string text) {
  for (const std::string_view special : {"\\", "[", "]", ":"})
    text = replaced(text, special, "\\" + std::string(special));
  return text;
}

std::string zsh_verb(const VerbEntry& verb) {
  std::string text = "        " + verb.name + ")\n          _arguments";
  const auto add = [&text](const std::string& specification) {
    text += " \\\n            " + shell_word(specification);
  };
  for (const OptionEntry& option : verb.options)
    for (const std::string& name : option.names) {
      std::string specification = "*" + name + "[" + zsh_text(option.description) + "]";
      if (!option.value.empty())
        specification += ":" + zsh_text(option.value) + ":" + zsh_action(option);
      add(specification);
    }
  for (std::size_t i = 0; i < verb.positionals.size(); ++i) {
    const OptionEntry& positional = verb.positionals[i];
    add(std::to_string(i + 1) + ":" + zsh_text(positional.description) + ":" +
        zsh_action(positional));
  }
  return text + " ;;\n";
}

constexpr std::string_view kZshHelpers = R"sh(_PROGRAM_bodies() {
  local -a names
  names=(${(f)"$(command poinsot list --names --timeout 1s 2> /dev/null)"})
  compadd -a names
}
_PROGRAM_worlds() {
  local -a names
  names=(${(f)"$(command poinsot list --worlds --timeout 1s 2> /dev/null)"})
  compadd -a names
}
)sh";

std::string zsh_script(const CommandTree& tree) {
  std::string text = "#compdef PROGRAM\n# Completion of PROGRAM for zsh.\n";
  text += kZshHelpers;
  text += "_PROGRAM() {\n  local line state\n  local -a verbs\n  verbs=(\n";
  for (const VerbEntry& verb : tree.verbs)
    text += "    " + shell_word(verb.name + ":" + zsh_text(verb.summary)) + "\n";
  text +=
      "  )\n  _arguments -C '--help[print help]' '--version[print the version]' "
      "'1:verb:->verb' '*::argument:->argument'\n"
      "  case $state in\n    verb) _describe verb verbs ;;\n    argument)\n"
      "      case $line[1] in\n";
  for (const VerbEntry& verb : tree.verbs) text += zsh_verb(verb);
  // As a file of the function path its first call runs all of it; else it is sourced.
  text +=
      "      esac ;;\n  esac\n}\n"
      "if [[ $funcstack[1] == _PROGRAM ]]; then\n  _PROGRAM \"$@\"\nelse\n"
      "  compdef _PROGRAM PROGRAM\nfi\n";
  return replaced(text, "PROGRAM", tree.program.name);
}

// Fish ------------------------------------------------------------------------------------------

std::string fish_values(const OptionEntry& option) {
  switch (source_of(option)) {
    case Source::words:
      return " -x -a " + shell_word(joined(choices(option), " "));
    case Source::bodies:
      return " -x -a '(command poinsot list --names --timeout 1s 2> /dev/null)'";
    case Source::worlds:
      return " -x -a '(command poinsot list --worlds --timeout 1s 2> /dev/null)'";
    case Source::files:
      return " -r -F";
    case Source::nothing:
      return option.value.empty() ? "" : " -x";
  }
  return "";
}

std::string fish_script(const CommandTree& tree) {
  std::string text = "# Completion of PROGRAM for fish.\ncomplete -c PROGRAM -f\n";
  for (const VerbEntry& verb : tree.verbs) {
    text += "complete -c PROGRAM -n __fish_use_subcommand -a " + verb.name + " -d " +
            shell_word(verb.summary) + "\n";
    const std::string here =
        "complete -c PROGRAM -n '__fish_seen_subcommand_from " + verb.name + "'";
    for (const OptionEntry& option : verb.options) {
      text += here;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      text += fish_values(option) + " -d " + shell_word(option.description) + "\n";
    }
    if (!verb.positionals.empty() && source_of(verb.positionals.front()) != Source::nothing)
      text += here + fish_values(verb.positionals.front()) + "\n";
  }
  return replaced(text, "PROGRAM", tree.program.name);
}

}  // namespace

std::string completion_script(const CommandTree& tree, Shell shell) {
  switch (shell) {
    case Shell::bash:
      return bash_script(tree);
    case Shell::zsh:
      return zsh_script(tree);
    case Shell::fish:
      return fish_script(tree);
  }
  return {};
}

}  // namespace poinsot
