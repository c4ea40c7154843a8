// A client that pushes and stays until it is killed: this test program again, as a process.

#pragma once

#include <string>
#include <vector>

#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// Arguments of the ChildProcess: pushes `body` of the only world with 3 N along x, for one second
// or until it is cleared; it does not outlive its client. Its output is the first and the last
// frame of effect.
std::vector<std::string> holding_client(const std::string& body, Hold hold = Hold::duration);

// The same for one that joins lock step with a patience of 60 s and never says `advance`.
std::vector<std::string> blocking_client();

// What main does when it is called so; does not return before it is killed.
int hold(int domain, const std::string& body, Hold hold);
int block(int domain);

}  // namespace poinsot
