// What this test program does as a child process: `bus_tests ROLE DOMAIN WORLD COUNT`.

#pragma once

#include <string>
#include <vector>

namespace poinsot {

struct Role {
  std::string name;
  int domain = 0;
  std::string world;
  int count = 0;
};

// The child's exit status.
int play(const Role& role);

// Arguments of a ChildProcess on this process's domain.
std::vector<std::string> role(const std::string& name, const std::string& world, int count = 0);

}  // namespace poinsot
