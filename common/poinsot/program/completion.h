// Completion scripts for shells, written from a program's verbs and options. What a value is called
// in the help text says how it is completed:
//
//   world|body   one of these words
//   BODY, WORLD  what the daemons that run now say (poinsot list --names, --worlds)
//   FILE, SCENE  files
//
// Names that come from the bus are never evaluated by the shell.

#pragma once

#include <array>
#include <string>

#include "poinsot/base/names.h"
#include "poinsot/program/command_tree.h"

namespace poinsot {

enum class Shell { bash, zsh, fish };

inline constexpr std::array<Named<Shell>, 3> kShellNames = {{
    {"bash", Shell::bash},
    {"zsh", Shell::zsh},
    {"fish", Shell::fish},
}};

std::string completion_script(const CommandTree& tree, Shell shell);

}  // namespace poinsot
