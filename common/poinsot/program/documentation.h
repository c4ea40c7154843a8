// The verbs `completion SHELL` and `man` of a program: what it says of itself for shells and man.
//
//   DocumentationVerbs documentation(app, "other(1)");   // after all other verbs
//   …parse…
//   if (const auto text = documentation.text()) std::cout << *text;

#pragma once

#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "poinsot/program/completion.h"

namespace poinsot {

class DocumentationVerbs {
 public:
  DocumentationVerbs(CLI::App& app, std::string see_also);

  // If one of the two verbs was given.
  std::optional<std::string> text() const;

 private:
  const CLI::App& app_;
  std::string see_also_;
  std::unique_ptr<Shell> shell_ = std::make_unique<Shell>(Shell::bash);
  const CLI::App* completion_;
  const CLI::App* man_;
};

}  // namespace poinsot
