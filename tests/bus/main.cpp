// The bus tests, and the other processes that they talk to (roles.h).
//
// Delivery inside one process is switched off by the profiles file, so that every test goes through
// the transports; it shows at the same time that profiles are honoured.

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/participant.h"

int main(int argc, char** argv) {
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", POINSOT_TEST_PROFILES, 1);
  poinsot::route_bus_log([](poinsot::BusLogLevel level, const std::string& message) {
    if (level == poinsot::BusLogLevel::error) std::fprintf(stderr, "bus: %s\n", message.c_str());
  });
  if (argc == 5) return poinsot::play({argv[1], std::stoi(argv[2]), argv[3], std::stoi(argv[4])});
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
