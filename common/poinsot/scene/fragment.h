// A scene fragment: bodies that are put into a run, as YAML with the key `bodies:` exactly as in a
// scene file. It may come from anywhere, so it names no file and is small.

#pragma once

#include <string_view>
#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

inline constexpr std::size_t kMaxFragmentText = 65535;  // [bytes]

// The bodies, each valid in itself and with a name that no other has. What they are to the bodies
// of a run is not known here. Reads nothing but the text; throws Error with all its faults,
// "spawn:line:col: …".
std::vector<BodyDef> parse_fragment(std::string_view text);

}  // namespace poinsot
