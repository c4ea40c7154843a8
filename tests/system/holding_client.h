// A client that pushes and stays until it is killed: this test program again, as a process.

#pragma once

#include <string>
#include <vector>

namespace poinsot {

// Arguments of the ChildProcess: pushes `body` of the only world with 3 N along x for one second.
// Its output is the first and the last frame of effect.
std::vector<std::string> holding_client(const std::string& body);

// What main does when it is called so; does not return before it is killed.
int hold(int domain, const std::string& body);

}  // namespace poinsot
