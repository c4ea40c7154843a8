// The man page and the completion scripts of a small program.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "poinsot/program/completion.h"
#include "poinsot/program/man_page.h"
#include "poinsot/program/options.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

class Documentation : public testing::Test {
 protected:
  Documentation() {
    set_plain_help(app_);
    add_version_option(app_);
    CLI::App* const push = app_.add_subcommand("push", "push a body");
    push->add_option("body", body_, "name of the body")->required()->type_name("BODY");
    push->add_option("-n,--count", count_, "how often")->check(CLI::PositiveNumber)->type_name("N");
    push->add_option("--frame", frame_, "the body's or the world's axes")->type_name("world|body");
    push->add_flag("--json", json_, "as [JSON]: an object");
    push->add_option("--secret", secret_, "not for everyone")->group("");
    push->footer("Example:\n  .leading dot\n  back\\slash");
    CLI::App* const load = app_.add_subcommand("load", "load it");
    load->add_option("file", file_, "a file")->type_name("FILE");
  }

  CommandTree tree() const { return read_tree(app_); }

  CLI::App app_{"a program", "tool"};
  std::string body_, frame_, secret_, file_;
  int count_ = 0;
  bool json_ = false;
};

TEST_F(Documentation, ReadsVerbsOptionsAndValues) {
  const CommandTree program = tree();
  EXPECT_EQ(program.program.name, "tool");
  ASSERT_EQ(program.verbs.size(), 2u);
  const VerbEntry& push = program.verbs.front();
  ASSERT_EQ(push.positionals.size(), 1u);
  EXPECT_EQ(push.positionals[0].value, "BODY");
  EXPECT_TRUE(push.positionals[0].required);
  ASSERT_EQ(push.options.size(), 4u);  // help, count, frame, json
  EXPECT_EQ(push.options[1].names, (std::vector<std::string>{"-n", "--count"}));
  EXPECT_EQ(push.options[1].value, "N") << "without the names of the checks";
  EXPECT_EQ(choices(push.options[2]), (std::vector<std::string>{"world", "body"}));
  EXPECT_EQ(push.options[3].value, "");
}

TEST_F(Documentation, AManualPageHasAllOfItAndNoStrayCommand) {
  const std::string page = man_page(tree(), "other(1)");
  for (const char* text : {".TH TOOL 1", ".SH NAME\ntool \\- a program\n",
                           "\\fBtool\\fR \\fBpush\\fR [\\fIOPTIONS\\fR] \\fIBODY\\fR",
                           "\\fB\\-n\\fR, \\fB\\-\\-count\\fR \\fIN\\fR", "POINSOT_DOMAIN_ID",
                           "EXIT STATUS", "other(1)", "back\\eslash"})
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  EXPECT_EQ(page.find("secret"), std::string::npos);
}

// What bash offers for a line whose last word is being typed.
std::string bash_offers(const std::string& script, const std::string& words) {
  const auto file = test::temp_path("completion.bash");
  std::ofstream(file) << script << "poinsot() { :; }\nCOMP_WORDS=(" << words
                      << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_tool\n"
                         "printf '%s ' \"${COMPREPLY[@]}\"\n";
  const std::string command = "timeout 20 bash " + file.string() + " 2>&1";
  std::string output;
  if (FILE* const pipe = popen(command.c_str(), "r")) {
    std::array<char, 256> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) output += part.data();
    pclose(pipe);
  }
  std::filesystem::remove(file);
  return output;
}

TEST_F(Documentation, BashCompletesVerbsOptionsAndChoices) {
  const std::string script = completion_script(tree(), Shell::bash);
  EXPECT_EQ(bash_offers(script, "tool p"), "push ");
  EXPECT_EQ(bash_offers(script, "tool push --f"), "--frame ");
  EXPECT_EQ(bash_offers(script, "tool push --frame ''"), "world body ");
  EXPECT_EQ(bash_offers(script, "tool push --frame w"), "world ");
  EXPECT_EQ(bash_offers(script, "tool push --count ''"), " ");
}

TEST_F(Documentation, OtherShellsGetEveryOptionAndNoHiddenOne) {
  for (const Shell shell : {Shell::zsh, Shell::fish}) {
    const std::string script = completion_script(tree(), shell);
    for (const char* text : {"push", "load", "count", "frame", "json", "list --names"})
      EXPECT_NE(script.find(text), std::string::npos) << text;
    EXPECT_EQ(script.find("secret"), std::string::npos);
    EXPECT_EQ(script.find("PROGRAM"), std::string::npos);
  }
  EXPECT_NE(completion_script(tree(), Shell::zsh).find("'*--json[as \\[JSON\\]\\: an object]'"),
            std::string::npos);
}

TEST(CompletionScript, OffersNamesFromTheBusWithoutEvaluatingThem) {
  CLI::App app("a program", "tool");
  std::string body;
  app.add_subcommand("push", "push it")->add_option("body", body)->type_name("BODY");
  std::string script = completion_script(read_tree(app), Shell::bash);
  script += "_tool_ask() { printf '%s\\n' 'big ball' '$(echo pwned)'; }\n";
  EXPECT_EQ(bash_offers(script, "tool push b"), "big\\ ball ");
  EXPECT_EQ(bash_offers(script, "tool push ''"), "big\\ ball \\$\\(echo\\ pwned\\) ");
}

}  // namespace
}  // namespace poinsot
