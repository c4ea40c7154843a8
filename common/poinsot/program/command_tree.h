// A program's verbs and options as plain data, read from its parser: what the man page and the
// completion scripts are made of.

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace poinsot {

struct OptionEntry {
  std::vector<std::string> names;  // "-n", "--count"; of a positional its one name
  std::string value;               // what follows, as "N" or "world|body"; empty: a flag
  std::string description;
  bool required = false;
};

struct VerbEntry {
  std::string name;
  std::string summary;
  std::string footer;                    // an example
  std::vector<OptionEntry> positionals;  // in order
  std::vector<OptionEntry> options;      // --help first
};

struct CommandTree {
  VerbEntry program;             // its own options; no positionals
  std::vector<VerbEntry> verbs;  // in the order of the help text, without hidden ones
};

CommandTree read_tree(const CLI::App& app);

// The words of a value like "world|body"; none if it is no choice.
std::vector<std::string> choices(const OptionEntry& option);

}  // namespace poinsot
