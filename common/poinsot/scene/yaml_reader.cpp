#include "poinsot/scene/yaml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

constexpr std::size_t kMaxQuote = 60;  // [bytes] of a value repeated in a message

std::string quoted(std::string_view text) {
  const bool cut = text.size() > kMaxQuote;
  return std::string("'").append(text.substr(0, kMaxQuote)).append(cut ? "…'" : "'");
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

std::string described(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::nothing:
      return "nothing";
    case YamlNode::Kind::list:
      return "a list of " + std::to_string(node.items.size());
    case YamlNode::Kind::map:
      return "a table";
    case YamlNode::Kind::scalar:
      break;
  }
  return node.quoted ? "the quoted text " + quoted(node.text) : quoted(node.text);
}

bool contains(std::span<const std::string_view> words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

// Decimal numbers as JSON and YAML 1.2 share them, and a leading '+'. Not: nan, inf, hex, octal or
// anything that looks octal, sexagesimal, underscores, what does not fit into a double.
std::optional<double> decimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || !(is_digit(text[0]) || text[0] == '.')) return std::nullopt;
  if (text.size() > 1 && text[0] == '0' && is_digit(text[1])) return std::nullopt;
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::general);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return negative ? -value : value;
}

}  // namespace

// Faults -----------------------------------------------------------------------------------------

std::string FaultList::where(const YamlNode& node) const {
  return file_ + ":" + std::to_string(node.line) + ":" + std::to_string(node.column);
}

void FaultList::add(const YamlNode& node, std::string what, const std::string& path) {
  if (!path.empty()) distrust(path);
  Placed fault{{node.line, node.column}, std::move(what)};
  if (std::ranges::find(faults_, fault) == faults_.end()) {
    if (faults_.size() < kMaxReported)
      faults_.push_back(std::move(fault));
    else
      ++more_;
  }
  if (++added_ < kMaxAdded) return;
  std::vector<SceneFault> found = sorted();
  found.push_back({file_, "too many faults, the rest is not looked at", {}});
  throw_faults(found);
}

void FaultList::place(const std::string& path, const YamlNode& node) {
  places_[path] = &node;
}

void FaultList::add(const std::vector<SceneFault>& found, const YamlNode& root) {
  for (const SceneFault& fault : found) {
    if (distrusted(fault.path)) continue;
    // The value's own place, or that of the nearest part of the scene around it.
    const YamlNode* node = &root;
    for (std::string path = fault.path; !path.empty();) {
      if (const auto place = places_.find(path); place != places_.end()) {
        node = place->second;
        break;
      }
      const auto cut = path.find_last_of(".[");
      path.resize(cut == std::string::npos ? 0 : cut);
    }
    add(*node, fault.what);
  }
}

std::vector<SceneFault> FaultList::sorted() const {
  std::vector<Placed> faults = faults_;
  std::ranges::stable_sort(faults, {}, &Placed::position);
  std::vector<SceneFault> result;
  for (Placed& fault : faults)
    result.push_back({file_ + ":" + std::to_string(fault.position.first) + ":" +
                          std::to_string(fault.position.second),
                      std::move(fault.what),
                      {}});
  if (more_ > 0) result.push_back({file_, "and " + std::to_string(more_) + " more faults", {}});
  return result;
}

// Maps -------------------------------------------------------------------------------------------

const YamlNode* Fields::find(std::string_view key) const {
  for (const auto& [name, value] : entries)
    if (name->text == key) return value;
  return nullptr;
}

const YamlNode* Fields::find_key(std::string_view key) const {
  for (const auto& [name, value] : entries)
    if (name->text == key) return name;
  return nullptr;
}

std::optional<Fields> YamlReader::fields(const YamlNode& node, std::string_view what,
                                         const KeyTable& table) {
  count(node);
  if (node.kind != YamlNode::Kind::map) {
    wrong_type(node, what, "a table of keys");
    return std::nullopt;
  }
  Fields result;
  for (const YamlNode::Entry& entry : node.entries) {
    const YamlNode& key = *entry.first;
    count(key);
    if (key.kind != YamlNode::Kind::scalar)
      faults_.add(key, "a key must be a word, is " + described(key));
    else if (const YamlNode* first = result.find_key(key.text))
      faults_.add(key, "duplicate key " + quoted(key.text) + ", first at line " +
                           std::to_string(first->line) + ", column " +
                           std::to_string(first->column));
    else if (contains(table.keys, key.text))
      result.entries.push_back(entry);
    else
      unknown_key(key, table);
  }
  return result;
}

void YamlReader::unknown_key(const YamlNode& key, const KeyTable& table) {
  if (contains(table.later, key.text))
    return faults_.add(key, quoted(key.text) + " is not supported yet");
  std::string what = "unknown key " + quoted(key.text);
  for (const KeyTable* place : kPlaces)
    if (contains(place->keys, key.text) || contains(place->later, key.text))
      return faults_.add(key, what.append(" here, it belongs in ").append(place->name));
  const std::string hint = key.text.size() <= kMaxQuote ? did_you_mean(key.text, table.keys) : "";
  faults_.add(key, what + (hint.empty() ? ", known here: " + joined(table.keys) : hint));
}

const YamlNode* YamlReader::required(const Fields& fields, const YamlNode& map,
                                     std::string_view what, std::string_view key) {
  const YamlNode* value = fields.find(key);
  if (!value) faults_.add(map, std::string(what).append(" needs the key ") + quoted(key));
  return value;
}

// Values -----------------------------------------------------------------------------------------

void YamlReader::count(const YamlNode& node, std::size_t values) {
  read_ += values;
  if (read_ > limits_.values)
    throw Error(faults_.where(node) + ": " + (limits_.files ? "a scene" : "a fragment") +
                " must not hold more than " + std::to_string(limits_.values) +
                " values, aliases counted");
}

void YamlReader::wrong_type(const YamlNode& node, std::string_view what,
                            std::string_view expected) {
  faults_.add(node, std::string(what).append(" must be ").append(expected).append(", is ") +
                        described(node));
}

const std::vector<const YamlNode*>* YamlReader::list(const YamlNode& node, std::string_view what) {
  count(node);
  if (node.kind == YamlNode::Kind::list) return &node.items;
  wrong_type(node, what, "a list");
  return nullptr;
}

std::optional<std::string> YamlReader::text(const YamlNode& node, std::string_view what) {
  count(node);
  if (node.kind == YamlNode::Kind::scalar) return node.text;
  wrong_type(node, what, "text");
  return std::nullopt;
}

std::optional<bool> YamlReader::boolean(const YamlNode& node, std::string_view what) {
  count(node);
  const bool is_word = node.kind == YamlNode::Kind::scalar && !node.quoted;
  if (is_word && node.text == "true") return true;
  if (is_word && node.text == "false") return false;
  wrong_type(node, what, "true or false");
  return std::nullopt;
}

std::optional<double> YamlReader::number(const YamlNode& node, std::string_view what) {
  count(node);
  if (node.kind == YamlNode::Kind::scalar && !node.quoted)
    if (const auto value = decimal(node.text)) return value;
  wrong_type(node, what, "a finite decimal number");
  return std::nullopt;
}

std::optional<int> YamlReader::whole(const YamlNode& node, std::string_view what) {
  const std::optional<double> value = number(node, what);
  if (!value) return std::nullopt;
  if (std::trunc(*value) == *value && std::abs(*value) <= std::numeric_limits<int>::max())
    return static_cast<int>(*value);
  wrong_type(node, what, "a whole number");
  return std::nullopt;
}

std::optional<double> YamlReader::positive(const YamlNode& node, std::string_view what,
                                           std::string_view unit) {
  const std::optional<double> value = number(node, what);
  if (!value || *value > 0) return value;
  faults_.add(node,
              std::string(what).append(" must be > 0 ").append(unit).append(", is ") + node.text);
  return std::nullopt;
}

std::optional<Vec3> YamlReader::vector(const YamlNode& node, std::string_view what) {
  count(node);
  if (node.kind != YamlNode::Kind::list || node.items.size() != 3) {
    wrong_type(node, what, "a list of 3 numbers");
    return std::nullopt;
  }
  Vec3 result = Vec3::Zero();
  bool complete = true;
  for (int i = 0; i < 3; ++i) {
    const auto value = number(*node.items[static_cast<std::size_t>(i)], what);
    complete = complete && value;
    result[i] = value.value_or(0);
  }
  return complete ? std::optional(result) : std::nullopt;
}

void YamlReader::unknown_word(const YamlNode& node, std::string_view what, const std::string& word,
                              std::span<const std::string_view> words,
                              std::span<const std::string_view> later) {
  const std::string known = ", known: " + joined(words);
  if (contains(later, word))
    return faults_.add(
        node, std::string(what).append(" ") + quoted(word) + " is not supported yet" + known);
  const std::string hint = word.size() <= kMaxQuote ? did_you_mean(word, words) : "";
  faults_.add(node, std::string("unknown ").append(what).append(" ") + quoted(word) +
                        (hint.empty() ? known : hint));
}

}  // namespace poinsot
