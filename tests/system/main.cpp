// The system tests; called as `system_tests hold DOMAIN BODY`, the client of holding_client.h.

#include <string>

#include <gtest/gtest.h>

#include "system/holding_client.h"

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "hold")
    return poinsot::hold(std::stoi(argv[2]), argv[3]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
