// The command-line client: one table of verbs, and the way from argv to an exit code.

#pragma once

#include <array>
#include <string_view>

#include "poinsot/cli/context.h"
#include "poinsot/cli/control.h"
#include "poinsot/cli/events.h"
#include "poinsot/cli/list.h"
#include "poinsot/cli/push.h"
#include "poinsot/cli/status.h"
#include "poinsot/cli/watch.h"

namespace poinsot {

struct Verb {
  std::string_view name;
  std::string_view summary;
  std::string_view example;
  Action (*declare)(CLI::App& app);  // adds its options, returns its work
};

inline constexpr std::array<Verb, 9> kVerbs = {{
    {"list", "daemons on the domain and their bodies", "poinsot list", declare_list},
    {"watch", "poses as they come: a live table, lines, or JSON",
     "poinsot watch\n  poinsot watch --body box --rate 10 --json -n 100", declare_watch},
    {"events", "impacts as they happen: lines or JSON", "poinsot events --body ball --json -n 10",
     declare_events},
    {"push", "push a body; prints the frames of effect",
     "poinsot push box --force 0,0,50 --for 0.5s\n"
     "  poinsot push box --force 5,0,0 --at 0,0,0.1 --frame body --hold\n"
     "  poinsot push box --clear",
     declare_push},
    {"pause", "stop after the current frame", "poinsot pause", declare_pause},
    {"resume", "go on", "poinsot resume", declare_resume},
    {"step", "advance so many frames, then stay paused", "poinsot step 60", declare_step},
    {"reset", "back to frame 0 of the scene", "poinsot reset", declare_reset},
    {"status", "how the run goes: pace, bodies, contacts, energy, commands",
     "poinsot status --json", declare_status},
}};

// What main does.
int run_client(int argc, const char* const* argv);

}  // namespace poinsot
