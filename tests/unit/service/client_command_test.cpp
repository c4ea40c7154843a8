#include "poinsot/service/client_command.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

namespace fs = std::filesystem;

// Two directories: bin with daemon and client, other with another client.
class ClientCommand : public ::testing::Test {
 protected:
  ClientCommand() : root_(fs::temp_directory_path() / "poinsot_client_command_XXXXXX") {
    std::string name = root_.string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    root_ = name;
    for (const char* directory : {"bin", "other"}) {
      fs::create_directory(root_ / directory);
      std::ofstream(root_ / directory / "poinsot") << "client";
    }
  }
  ~ClientCommand() override { fs::remove_all(root_); }

  std::string command(const std::string& search_path) const {
    return client_command(root_ / "bin" / "poinsotd", search_path);
  }
  std::string bin() const { return (root_ / "bin").string(); }
  std::string other() const { return (root_ / "other").string(); }

  fs::path root_;
};

TEST_F(ClientCommand, IsItsNameWhereTheShellFindsIt) {
  EXPECT_EQ(command(bin()), "poinsot");
  EXPECT_EQ(command("/nowhere:" + bin() + ":" + other()), "poinsot");
}

TEST_F(ClientCommand, IsItsPathWhereTheShellFindsNoneOrAnother) {
  EXPECT_EQ(command(""), bin() + "/poinsot");
  EXPECT_EQ(command("/nowhere"), bin() + "/poinsot");
  EXPECT_EQ(command(other() + ":" + bin()), bin() + "/poinsot");
}

TEST_F(ClientCommand, IsItsNameWhereNoneStandsBesideTheDaemon) {
  fs::remove(root_ / "bin" / "poinsot");
  EXPECT_EQ(command("/nowhere"), "poinsot");
}

}  // namespace
}  // namespace poinsot
