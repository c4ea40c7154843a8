// YAML text as a tree that knows where each node stands. The one door to yaml-cpp.
//
// Promise: everything that a strict reader needs survives: duplicate keys, whether a scalar was
// quoted, line and column (from 1; columns count bytes). Hostile text (nesting, aliases that hold
// themselves, size) is an error, never a crash.

#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace poinsot {

inline constexpr std::size_t kMaxYamlText = 32u << 20;  // [bytes] of a file

struct YamlNode {
  enum class Kind { nothing, scalar, list, map };
  using Entry = std::pair<const YamlNode*, const YamlNode*>;  // key, value

  Kind kind = Kind::nothing;
  bool quoted = false;  // a scalar in quotes is text, whatever it looks like
  int line = 1;
  int column = 1;
  std::string text;                    // of a scalar
  std::vector<const YamlNode*> items;  // of a list
  std::vector<Entry> entries;          // of a map, in file order, duplicates kept
};

struct YamlTree {
  std::deque<YamlNode> nodes;  // owns all; an alias is the node of its anchor, seen again
  const YamlNode* root = nullptr;
};

// Throws Error "file:line:col: what" for text that is not one YAML document.
YamlTree parse_yaml(std::string_view text, const std::string& file);

}  // namespace poinsot
