// Which program this is: another text for every build whose code is another.

#pragma once

#include <string>

namespace poinsot {

// Version, compiler and the linker's hash of the program: "0.5.0, GCC 12.2.0, 3f07…".
const std::string& build_identity();

}  // namespace poinsot
