#include "poinsot/cli/findings.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/json_line.h"

namespace poinsot {

std::string finding_text(const Finding& finding) {
  std::string text = fmt::format("{:<5} {:<16} {}\n", name_of<Health>(kHealthNames, finding.health),
                                 finding.topic, finding.text);
  if (!finding.advice.empty()) text += fmt::format("{:<22} → {}\n", "", finding.advice);
  return text;
}

std::string findings_json(const Findings& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings)
    list.push_back({{"health", name_of<Health>(kHealthNames, finding.health)},
                    {"topic", finding.topic},
                    {"text", finding.text},
                    {"advice", finding.advice}});
  return json_line({{"ok", !has_failed(findings)}, {"findings", std::move(list)}});
}

bool has_failed(const Findings& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.health == Health::fail; });
}

}  // namespace poinsot
