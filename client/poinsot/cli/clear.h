// poinsot clear: ends what is held; poinsot pushes: lists it.

#pragma once

#include <cstdint>
#include <string>

#include "poinsot/cli/context.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct ClearOptions {
  std::string body;  // empty: all
  std::uint32_t slot = 0;
  std::string client;  // 16 hexadecimal digits; empty: this user's
  bool json = false;
};

void add_clear_options(CLI::App& app, ClearOptions& options);
WrenchCommand to_command(const ClearOptions& options);

Action declare_clear(CLI::App& app);
Action declare_pushes(CLI::App& app);

}  // namespace poinsot
