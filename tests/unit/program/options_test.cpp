#include "poinsot/program/options.h"

#include <cstdlib>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/program/exit_code.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

// A program with one verb, as both executables are.
class Options : public ::testing::Test {
 protected:
  Options() {
    unsetenv("POINSOT_DOMAIN_ID");
    set_plain_help(app_);
    add_version_option(app_);
    app_.require_subcommand(1);
    app_.footer(exit_code_help());
    push_ = app_.add_subcommand("push", "push a body");
    app_.add_subcommand("pause", "pause the run");
    push_->add_option("body", body_, "name")->required();
    add_vector_option(*push_, "--force", force_, "force");
    add_duration_option(*push_, "--for", duration_, "how long");
    add_bus_options(*push_, bus_);
    add_verbose_option(*push_, verbosity_);
  }
  ~Options() override { unsetenv("POINSOT_DOMAIN_ID"); }

  std::optional<int> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "poinsot");
    return parse_command_line(app_, static_cast<int>(arguments.size()), arguments.data(), out_,
                              err_);
  }

  CLI::App app_{"a program", "poinsot"};
  CLI::App* push_ = nullptr;
  std::string body_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  std::chrono::nanoseconds duration_{0};
  BusFlags bus_;
  int verbosity_ = 0;
  std::ostringstream out_, err_;
};

TEST_F(Options, ReadTypedValues) {
  EXPECT_EQ(parse({"push", "box", "--force", "-1,0,50", "--for", "0.5s", "--domain", "5",
                   "--listen", "lan", "-vv"}),
            std::nullopt);
  EXPECT_EQ(body_, "box");
  EXPECT_EQ(force_, Eigen::Vector3d(-1, 0, 50));
  EXPECT_EQ(duration_, 500ms);
  EXPECT_EQ(bus_.domain, 5);
  EXPECT_TRUE(bus_.lan);
  EXPECT_EQ(verbosity_, 2);
  EXPECT_EQ(err_.str(), "");
}

TEST_F(Options, DefaultToTheLocalHostAndDomain77) {
  EXPECT_EQ(parse({"push", "box"}), std::nullopt);
  EXPECT_EQ(bus_.domain, 77);
  EXPECT_FALSE(bus_.lan);
}

TEST_F(Options, TakeTheDomainFromTheEnvironmentUnlessGiven) {
  setenv("POINSOT_DOMAIN_ID", "101", 1);
  EXPECT_EQ(parse({"push", "box"}), std::nullopt);
  EXPECT_EQ(bus_.domain, 101);
  EXPECT_EQ(parse({"push", "box", "--domain", "12"}), std::nullopt);
  EXPECT_EQ(bus_.domain, 12);
}

TEST_F(Options, NameTheEnvironmentVariableOfABadDomain) {
  setenv("POINSOT_DOMAIN_ID", "lots", 1);
  EXPECT_EQ(parse({"push", "box"}), 2);
  EXPECT_NE(err_.str().find("'lots' (option or environment variable POINSOT_DOMAIN_ID)"),
            std::string::npos)
      << err_.str();
}

TEST_F(Options, RefuseADomainOutOfRange) {
  for (const char* domain : {"233", "-1", "7.5", "", "0x10"})
    EXPECT_EQ(parse({"push", "box", "--domain", domain}), 2) << domain;
}

TEST_F(Options, TakePartitionAndDiscoveryServerFromTheEnvironmentUnlessGiven) {
  setenv("POINSOT_PARTITION", "lab", 1);
  setenv("POINSOT_DISCOVERY_SERVER", "10.0.0.1:11811", 1);
  EXPECT_EQ(parse({"push", "box", "--partition", "desk"}), std::nullopt);
  EXPECT_EQ(bus_.partition, "desk");
  EXPECT_EQ(bus_.discovery_server, "10.0.0.1:11811");
  unsetenv("POINSOT_PARTITION");
  unsetenv("POINSOT_DISCOVERY_SERVER");
}

TEST_F(Options, RefuseAServerWithoutAPort) {
  for (const char* server : {"127.0.0.1", ":11811", "host:", "host:0", "host:70000", "host:1x"})
    EXPECT_EQ(parse({"push", "box", "--discovery-server", server}), 2) << server;
  EXPECT_EQ(parse({"push", "box", "--discovery-server", "host:11811"}), std::nullopt);
}

TEST_F(Options, SuggestTheNearestOption) {
  EXPECT_EQ(parse({"push", "box", "--forse", "1,2,3"}), 2);
  EXPECT_EQ(err_.str(),
            "poinsot: unknown option '--forse', did you mean '--force'?\n"
            "Try 'poinsot push --help'.\n");
  EXPECT_EQ(out_.str(), "");
}

TEST_F(Options, SuggestTheNearestOptionWrittenWithItsValue) {
  EXPECT_EQ(parse({"push", "box", "--forse=1,2,3"}), 2);
  EXPECT_NE(err_.str().find("'--forse', did you mean '--force'?"), std::string::npos);
}

TEST_F(Options, SuggestTheNearestVerb) {
  EXPECT_EQ(parse({"psh", "box"}), 2);
  EXPECT_EQ(err_.str(),
            "poinsot: unknown verb 'psh', did you mean 'push'?\n"
            "Try 'poinsot --help'.\n");
}

TEST_F(Options, ListTheVerbsWhenNoneIsGiven) {
  EXPECT_EQ(parse({}), 2);
  EXPECT_NE(err_.str().find("no verb given: one of push pause"), std::string::npos) << err_.str();
}

TEST_F(Options, NameTheOptionOfABadValue) {
  EXPECT_EQ(parse({"push", "box", "--force", "up"}), 2);
  EXPECT_NE(err_.str().find("--force: 'up' is not a vector"), std::string::npos) << err_.str();
  EXPECT_EQ(parse({"push", "box", "--listen", "moon"}), 2);
  EXPECT_NE(err_.str().find("--listen: 'moon' is not one of local, lan"), std::string::npos)
      << err_.str();
}

TEST_F(Options, SuggestTheNearestChoice) {
  EXPECT_EQ(parse({"push", "box", "--listen", "locl"}), 2);
  EXPECT_NE(err_.str().find("'locl' is not one of local, lan, did you mean 'local'?"),
            std::string::npos)
      << err_.str();
}

TEST_F(Options, SayThatAnArgumentIsMissing) {
  EXPECT_EQ(parse({"push"}), 2);
  EXPECT_NE(err_.str().find("body is required"), std::string::npos) << err_.str();
}

TEST_F(Options, PrintHelpWithTheExitCodesOnStdout) {
  EXPECT_EQ(parse({"--help"}), 0);
  EXPECT_NE(out_.str().find("Exit codes:\n  0  done"), std::string::npos) << out_.str();
  EXPECT_EQ(err_.str(), "");
}

TEST_F(Options, PrintHelpOfAVerbWithTheNamesOfItsValues) {
  EXPECT_EQ(parse({"push", "--help"}), 0);
  for (const char* text : {"--force X,Y,Z  ", "--for TIME  ", "--listen local|lan  ",
                           "--domain N  ", "POINSOT_DOMAIN_ID"})
    EXPECT_NE(out_.str().find(text), std::string::npos) << text << "\n" << out_.str();
}

TEST_F(Options, PrintTheVersionOnStdout) {
  EXPECT_EQ(parse({"--version"}), 0);
  EXPECT_TRUE(out_.str().starts_with("poinsot 0.")) << out_.str();
}

}  // namespace
}  // namespace poinsot
