// What a doctor finds: a list of findings, in words and as JSON.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "poinsot/base/names.h"

namespace poinsot {

enum class Health { ok, warn, fail };
inline constexpr std::array<Named<Health>, 3> kHealthNames = {{
    {"ok", Health::ok},
    {"warn", Health::warn},
    {"fail", Health::fail},
}};

struct Finding {
  Health health = Health::ok;
  std::string topic;   // a word or two
  std::string text;    // what is so
  std::string advice;  // what to do; empty if all is well
};
using Findings = std::vector<Finding>;

// "ok    shared memory  64 MB free"; advice on a line of its own.
std::string finding_text(const Finding& finding);
std::string findings_json(const Findings& findings);
bool has_failed(const Findings& findings);

}  // namespace poinsot
