#include "poinsot/cli/documentation.h"

#include "poinsot/cli/output.h"
#include "poinsot/program/completion.h"
#include "poinsot/program/man_page.h"

namespace poinsot {

Action declare_completion(CLI::App& app) {
  const auto shell = std::make_shared<Shell>(Shell::bash);
  add_choice_option<Shell>(app, "shell", *shell, kShellNames, "whose")->required();
  return [&app, shell](const Context&) {
    put(completion_script(read_tree(*app.get_parent()), *shell));
    return ExitCode::ok;
  };
}

Action declare_man(CLI::App& app) {
  return [&app](const Context&) {
    put(man_page(read_tree(*app.get_parent()), "poinsotd(1)"));
    return ExitCode::ok;
  };
}

}  // namespace poinsot
