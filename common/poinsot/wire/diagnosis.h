// What a look at this machine tells of the bus, without joining it.

#pragma once

#include <string>
#include <vector>

namespace poinsot {

std::string bus_library();  // "Fast DDS 2.9.1"

// Whether Fast DDS takes this file of profiles (XML). It is read in, for the whole process, as
// joining the bus would.
bool takes_profiles(const std::string& file);

// UDP ports of domain `domain`: for each of the participants that can meet on this host, its port
// for discovery and the one for data; and the one that all listen to, for multicast.
struct PortPlan {
  std::vector<int> unicast;
  int multicast = 0;
};
PortPlan port_plan(int domain);

// Files of Fast DDS in shared memory: of all processes, and segments whose owner is dead.
struct SharedFiles {
  int files = 0;
  int stale_segments = 0;
};
SharedFiles shared_files();

}  // namespace poinsot
