// What the programs say of themselves: completion scripts, manual pages, the doctor.

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

Ended shell(const std::string& script, const Words& arguments) {
  Words words = {"-c", script};
  words.insert(words.end(), arguments.begin(), arguments.end());
  ChildProcess process("/bin/bash", words);
  Ended ended;
  ended.out = process.read_rest();
  ended.code = process.wait();
  ended.errors = process.errors();
  return ended;
}

// What bash offers for the last of these words.
std::string offered(const std::string& program, const std::string& name, const std::string& words) {
  const Ended ended = shell(R"(
    source <("$0" completion bash) || exit 1
    COMP_WORDS=($2); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMP_LINE="$2"; COMP_POINT=${#COMP_LINE}
    function=$(complete -p "$1" | sed 's/.*-F \([^ ]*\) .*/\1/')
    "$function" "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
    printf '%s ' "${COMPREPLY[@]}")",
                            {program, name, words});
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "");
  return ended.out;
}

TEST(Completion, IsBashThatOffersVerbsAndOptions) {
  for (const char* program : {POINSOT_CLIENT, POINSOT_DAEMON}) {
    const Ended ended = shell(R"("$0" completion bash | bash -n)", {program});
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(ended.errors, "");
  }
  EXPECT_EQ(offered(POINSOT_CLIENT, "poinsot", "poinsot pu"), "push pushes ");
  EXPECT_NE(offered(POINSOT_CLIENT, "poinsot", "poinsot push --imp").find("--impulse"),
            std::string::npos);
  EXPECT_NE(offered(POINSOT_DAEMON, "poinsotd", "poinsotd run --sup").find("--supervise"),
            std::string::npos);
}

TEST(Manual, IsRoffWithEveryVerb) {
  for (const auto& [program, verb] :
       {std::pair{POINSOT_CLIENT, "restore"}, std::pair{POINSOT_DAEMON, "replay"}}) {
    ChildProcess process(program, {"man"});
    const std::string page = process.read_rest();
    EXPECT_EQ(process.wait(), 0);
    EXPECT_EQ(page.substr(0, 4), ".TH ");
    EXPECT_NE(page.find(verb), std::string::npos);
  }
}

TEST(Doctor, EndsWithZeroUnlessALineSaysWhatFailed) {
  const Daemon daemon("tennis_racket", {"--paused"});
  const Ended ended = client({"doctor"});
  const bool told = ("\n" + ended.out).find("\nfail ") != std::string::npos;
  EXPECT_EQ(ended.code, told ? 1 : 0) << ended.out << ended.errors;
  EXPECT_NE(ended.out.find("tennis_racket: paused"), std::string::npos) << ended.out;
}

TEST(Help, IsThereForEveryVerbWithAnExample) {
  const std::string all = run_client_alone({"--help"}).out;
  for (const char* verb : {"push", "drag", "clear", "pushes", "spawn", "remove", "set", "save",
                           "restore", "record", "replay", "hz", "delay", "doctor", "shutdown"}) {
    EXPECT_NE(all.find(verb), std::string::npos) << verb;
    const Ended help = run_client_alone({verb, "--help"});
    EXPECT_EQ(help.code, 0) << verb;
    EXPECT_NE(help.out.find("Example"), std::string::npos) << verb;
  }
}

}  // namespace
}  // namespace poinsot
