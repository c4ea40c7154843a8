#include "poinsot/runner/whole_file.h"

#include <fcntl.h>
#include <fstream>
#include <string>
#include <sys/file.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "support/temp_path.h"

namespace poinsot {
namespace {

TEST(WholeFile, WhatADeadProcessLeftHalfWrittenIsRemoved) {
  const auto directory = test::temp_path("left");
  std::filesystem::create_directories(directory);
  // Numbers of processes come again: 1 is somebody, and this process is as well.
  const std::string mine = ".auto-3." + std::to_string(::getpid()) + ".partial";
  for (const std::string& name : {std::string(".auto-1.1.partial"), mine})
    std::ofstream(directory / name) << "half";
  for (const char* name : {"x.partial", ".hidden"}) std::ofstream(directory / name) << "other";
  write_whole_file(directory / "new", {});
  EXPECT_FALSE(std::filesystem::exists(directory / ".auto-1.1.partial"));
  EXPECT_FALSE(std::filesystem::exists(directory / mine));
  for (const char* name : {"x.partial", ".hidden", "new"})
    EXPECT_TRUE(std::filesystem::exists(directory / name)) << name;
}

TEST(WholeFile, WhatIsBeingWrittenIsLeftAlone) {
  const auto directory = test::temp_path("busy");
  std::filesystem::create_directories(directory);
  const auto busy = directory / ".auto-1.1.partial";
  const int writer = ::open(busy.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(writer, 0);
  ASSERT_EQ(::flock(writer, LOCK_EX | LOCK_NB), 0);
  write_whole_file(directory / "new", {});
  EXPECT_TRUE(std::filesystem::exists(busy));
  ::close(writer);
  write_whole_file(directory / "new", {});
  EXPECT_FALSE(std::filesystem::exists(busy));
}

}  // namespace
}  // namespace poinsot
