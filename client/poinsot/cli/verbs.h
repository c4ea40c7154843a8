// The command-line client: one table of verbs, and the way from argv to an exit code.

#pragma once

#include <array>
#include <string_view>

#include "poinsot/cli/bodies.h"
#include "poinsot/cli/checkpoint.h"
#include "poinsot/cli/clear.h"
#include "poinsot/cli/contacts.h"
#include "poinsot/cli/context.h"
#include "poinsot/cli/control.h"
#include "poinsot/cli/delay.h"
#include "poinsot/cli/doctor.h"
#include "poinsot/cli/documentation.h"
#include "poinsot/cli/drag.h"
#include "poinsot/cli/events.h"
#include "poinsot/cli/hz.h"
#include "poinsot/cli/list.h"
#include "poinsot/cli/push.h"
#include "poinsot/cli/record.h"
#include "poinsot/cli/status.h"
#include "poinsot/cli/watch.h"

namespace poinsot {

struct Verb {
  std::string_view name;
  std::string_view summary;
  std::string_view example;
  Action (*declare)(CLI::App& app);  // adds its options, returns its work
  bool on_bus = true;                // has the options of the bus
};

inline constexpr std::array<Verb, 28> kVerbs = {{
    {"list", "daemons on the domain and their bodies", "poinsot list", declare_list},
    {"status", "how the run goes: pace, bodies, contacts, energy, commands, clients",
     "poinsot status --json", declare_status},
    {"watch", "poses as they come: a live table, lines, or JSON",
     "poinsot watch\n  poinsot watch --body box --rate 10 --json -n 100\n"
     "  poinsot watch --match 'wheel_*' --deadband 0.001",
     declare_watch},
    {"events", "impacts as they happen: lines or JSON", "poinsot events --body ball --json -n 10",
     declare_events},
    {"contacts", "contact points and their forces, frame by frame: lines or JSON",
     "poinsot contacts --body box -n 1", declare_contacts},
    {"push", "push a body, now or held until 'clear'; prints the frames of effect",
     "poinsot push box --force 0,0,50 --for 0.5s\n"
     "  poinsot push box --force 5,0,0 --at 0,0,0.1 --frame body --hold\n"
     "  poinsot push box --impulse 0,0,2\n"
     "  poinsot clear box",
     declare_push},
    {"drag", "drag a body to a point by a spring with damping, until 'clear'",
     "poinsot drag box --to 0,0,1\n  poinsot drag box --to 1,0,1 --at 0.1,0,0 --for 2s",
     declare_drag},
    {"clear", "end what you hold: pushes and drags, of one body or of all",
     "poinsot clear box\n  poinsot clear", declare_clear},
    {"pushes", "what is held on bodies now, and by whom", "poinsot pushes --json", declare_pushes},
    {"spawn", "put bodies into the running scene",
     "echo 'bodies: [{name: ball2, shape: {sphere: 0.1}, mass: 1, position: [0, 0, 3]}]' |\n"
     "    poinsot spawn -",
     declare_spawn},
    {"remove", "take a body out of the running scene", "poinsot remove box", declare_remove},
    {"set", "put a body somewhere, or give it a velocity, at once",
     "poinsot set box --position 0,0,1 --rpy 0,0,1.57 --velocity 0,0,0", declare_set},
    {"pause", "stop after the current frame", "poinsot pause", declare_pause},
    {"resume", "go on", "poinsot resume", declare_resume},
    {"step", "advance so many frames, then stay paused", "poinsot step 60", declare_step},
    {"until", "go on until a time, then pause; returns when it is reached", "poinsot until 12.5s",
     declare_until},
    {"scale", "how fast simulated time passes", "poinsot scale 0.1\n  poinsot scale 0",
     declare_scale},
    {"reset", "back to frame 0 of the scene, or a part of that",
     "poinsot reset\n  poinsot reset --state --spawned", declare_reset},
    {"save", "keep the state of the run, to go on from it later",
     "poinsot save before_the_push\n  poinsot save --disk", declare_save},
    {"restore", "go on from a state that was saved", "poinsot restore before_the_push",
     declare_restore},
    {"record", "write a log of the run: every command, and the hash of every frame",
     "poinsot record today\n  poinsot record --stop", declare_record},
    {"replay", "run a log again, and name the first frame that differs", "poinsot replay today.log",
     declare_replay, false},
    {"shutdown", "end the daemon", "poinsot shutdown", declare_shutdown},
    {"hz", "how often samples of a topic come, how evenly, how many are lost", "poinsot hz poses",
     declare_hz},
    {"delay", "how old poses are when they come, or how long a push takes to be seen",
     "poinsot delay -n 600\n  poinsot delay --push box -n 20", declare_delay},
    {"doctor", "look for what keeps programs from meeting on the bus", "poinsot doctor",
     declare_doctor},
    {"completion", "a script that completes this tool's words in a shell",
     "source <(poinsot completion bash)", declare_completion, false},
    {"man", "the manual page, as roff", "poinsot man | man -l -", declare_man, false},
}};

// What main does.
int run_client(int argc, const char* const* argv);

}  // namespace poinsot
