// Typed reading of a YAML tree that collects faults instead of stopping at the first.
//
// Every function that reads a value reports what is wrong with it, once, at its place, and returns
// nothing in that case: the caller only asks whether there is a value.

#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "poinsot/base/names.h"
#include "poinsot/math/types.h"
#include "poinsot/scene/scene.h"
#include "poinsot/scene/scene_keys.h"
#include "poinsot/scene/yaml_tree.h"

namespace poinsot {

// The faults of one file, and where the values of the scene stand in it. However many faults a file
// has, its report and the work for it are bounded.
class FaultList {
 public:
  static constexpr std::size_t kMaxReported = 1000;
  static constexpr std::size_t kMaxAdded = 100'000;  // aliases may repeat a fault as often

  explicit FaultList(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  std::string where(const YamlNode& node) const;  // "file:line:col"

  // A fault at a node. `path` names the value in the scene that is thereby not to be trusted, so
  // that validate() does not report the same mistake again. Throws what there is after kMaxAdded.
  void add(const YamlNode& node, std::string what, const std::string& path = {});

  void place(const std::string& path, const YamlNode& node);  // the value at `path` stands here
  void distrust(const std::string& path) { distrusted_.insert(path); }
  bool distrusted(const std::string& path) const { return distrusted_.contains(path); }

  // Takes over what validate() found, at the places of the values.
  void add(const std::vector<SceneFault>& found, const YamlNode& root);

  std::vector<SceneFault> sorted() const;  // in file order; the last says how many more

 private:
  struct Placed {
    std::pair<int, int> position;  // line, column
    std::string what;
    bool operator==(const Placed&) const = default;
  };

  std::string file_;
  std::vector<Placed> faults_;  // no two alike, at most kMaxReported
  std::size_t added_ = 0;
  std::size_t more_ = 0;  // not in faults_
  std::map<std::string, const YamlNode*> places_;
  std::set<std::string> distrusted_;
};

// The keys of one map, each known to the table and unique.
struct Fields {
  const YamlNode* find(std::string_view key) const;      // the value
  const YamlNode* find_key(std::string_view key) const;  // the key itself, for its place

  std::vector<YamlNode::Entry> entries;
};

// What a text may do.
struct ReadLimits {
  std::size_t values = 10'000'000;  // at most, aliases counted
  bool files = true;                // it may name files, which are read
};

class YamlReader {
 public:
  explicit YamlReader(FaultList& faults, ReadLimits limits = {})
      : faults_(faults), limits_(limits) {}

  bool may_name_files() const { return limits_.files; }

  // `what` is the key as the user wrote it; it begins the message.
  std::optional<Fields> fields(const YamlNode& node, std::string_view what, const KeyTable& table);
  const std::vector<const YamlNode*>* list(const YamlNode& node, std::string_view what);
  std::optional<std::string> text(const YamlNode& node, std::string_view what);
  std::optional<bool> boolean(const YamlNode& node, std::string_view what);
  std::optional<double> number(const YamlNode& node, std::string_view what);
  std::optional<int> whole(const YamlNode& node, std::string_view what);
  std::optional<double> positive(const YamlNode& node, std::string_view what,
                                 std::string_view unit);
  std::optional<Vec3> vector(const YamlNode& node, std::string_view what);

  // Counts what was read at a node towards the most that a text may hold; throws Error beyond it.
  void count(const YamlNode& node, std::size_t values = 1);

  // The value of a required key of a map; a missing one is a fault of the map.
  const YamlNode* required(const Fields& fields, const YamlNode& map, std::string_view what,
                           std::string_view key);

  // A member of a closed set of names; those in `later` are refused as not supported yet.
  template <class Value>
  std::optional<Value> named(const YamlNode& node, std::string_view what,
                             std::span<const Named<Value>> table,
                             std::span<const std::string_view> later) {
    const std::optional<std::string> name = text(node, what);
    if (!name) return std::nullopt;
    if (const auto value = find_named(table, *name)) return value;
    std::vector<std::string_view> words;
    for (const auto& row : table) words.push_back(row.name);
    unknown_word(node, what, *name, words, later);
    return std::nullopt;
  }

 private:
  void unknown_key(const YamlNode& key, const KeyTable& table);
  void unknown_word(const YamlNode& node, std::string_view what, const std::string& word,
                    std::span<const std::string_view> words,
                    std::span<const std::string_view> later);
  void wrong_type(const YamlNode& node, std::string_view what, std::string_view expected);

  FaultList& faults_;
  ReadLimits limits_;
  std::size_t read_ = 0;  // values, counted again for each alias
};

}  // namespace poinsot
