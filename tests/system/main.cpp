// The system tests; called as `system_tests push|hold|block DOMAIN BODY`, a client of
// holding_client.h.

#include <string>

#include <gtest/gtest.h>

#include "system/holding_client.h"

int main(int argc, char** argv) {
  using namespace poinsot;
  const std::string role = argc == 4 ? argv[1] : "";
  if (role == "push") return hold(std::stoi(argv[2]), argv[3], Hold::duration);
  if (role == "hold") return hold(std::stoi(argv[2]), argv[3], Hold::until_cleared);
  if (role == "block") return block(std::stoi(argv[2]));
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
