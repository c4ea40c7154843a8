#include "poinsot/program/documentation.h"

#include "poinsot/program/man_page.h"
#include "poinsot/program/options.h"

namespace poinsot {

DocumentationVerbs::DocumentationVerbs(CLI::App& app, std::string see_also)
    : app_(app), see_also_(std::move(see_also)) {
  CLI::App* const completion =
      app.add_subcommand("completion", "A script that completes this program's words in a shell");
  add_choice_option<Shell>(*completion, "shell", *shell_, kShellNames, "Whose")->required();
  completion_ = completion;
  man_ = app.add_subcommand("man", "The manual page, as roff");
}

std::optional<std::string> DocumentationVerbs::text() const {
  if (completion_->parsed()) return completion_script(read_tree(app_), *shell_);
  if (man_->parsed()) return man_page(read_tree(app_), see_also_);
  return std::nullopt;
}

}  // namespace poinsot
