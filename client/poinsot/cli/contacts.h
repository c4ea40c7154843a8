// poinsot contacts: all contact points of a frame and their forces, as lines or as JSON.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "poinsot/cli/context.h"

namespace poinsot {

struct ContactsOptions {
  std::vector<std::string> bodies;  // of which one must take part; empty: any
  std::uint64_t count = 0;          // end after so many frames; 0: when asked
  bool json = false;
};

void add_contacts_options(CLI::App& app, ContactsOptions& options);
Action declare_contacts(CLI::App& app);

}  // namespace poinsot
