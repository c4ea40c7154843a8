// One entry of a list of a scene file, read key by key. Private to this module.
//
// Faults go to the list; what could not be read keeps its value, and validate() is told not to look
// at it again.

#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "poinsot/scene/pose_reader.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

class EntryReader {
 public:
  EntryReader(const YamlNode& node, std::string_view what, const std::string& path,
              const KeyTable& table, FaultList& faults, YamlReader& reader)
      : node_(node), what_(what), path_(path), faults_(faults), reader_(reader) {
    faults_.place(path_, node_);
    fields_ = reader_.fields(node_, what_, table);
    // A key that was refused may have been meant for one that now seems to be missing.
    if (!fields_ || fields_->entries.size() < node_.entries.size()) faults_.distrust(path_);
  }

  bool is_table() const { return fields_.has_value(); }
  bool has(std::string_view key) const { return fields_->find(key) != nullptr; }

  void required(std::string_view key) {
    if (!reader_.required(*fields_, node_, what_, key)) distrust(key);
  }
  void name(std::string_view key, std::string& value, bool names_known) {
    if (!names_known) distrust(key);
    const YamlNode* node = find(key);
    if (!node) return;
    const auto text = reader_.text(*node, key);
    value = text.value_or("");
    if (!text || text->empty()) distrust(key);
    if (text && text->empty()) faults_.add(*node, std::string(key) + " must not be empty");
  }
  void number(std::string_view key, double& value) {
    if (!read_number(*fields_, key, path_, value, faults_, reader_)) distrust(key);
  }
  void number(std::string_view key, std::optional<double>& value) {
    double read = 0;
    if (!has(key)) return;
    number(key, read);
    if (!faults_.distrusted(path_of(key))) value = read;
  }
  void vector(std::string_view key, Vec3& value) {
    if (!read_vector(*fields_, key, path_, value, faults_, reader_)) distrust(key);
  }
  void boolean(std::string_view key, bool& value) {
    const YamlNode* node = find(key);
    if (!node) return;
    const auto read = reader_.boolean(*node, key);
    value = read.value_or(value);
    if (!read) distrust(key);
  }
  template <class Value, std::size_t kCount>
  void word(std::string_view key, const std::array<Named<Value>, kCount>& table, Value& value) {
    const YamlNode* node = find(key);
    if (!node) return;
    const auto read = reader_.named<Value>(*node, key, table, {});
    value = read.value_or(value);
    if (!read) distrust(key);
  }
  // A fault of the value at `key`, or of the entry.
  void refuse(std::string_view key, std::string what) {
    const YamlNode* node = fields_->find_key(key);
    faults_.add(node ? *node : node_, std::move(what), path_of(key));
  }

 private:
  std::string path_of(std::string_view key) const {
    return std::string(path_).append(".").append(key);
  }
  const YamlNode* find(std::string_view key) {
    const YamlNode* node = fields_->find(key);
    if (node) faults_.place(path_of(key), *node);
    return node;
  }
  // Neither the value nor what it has to do with others is looked at again.
  void distrust(std::string_view key) {
    faults_.distrust(path_of(key));
    faults_.distrust(path_);
  }

  const YamlNode& node_;
  std::string_view what_;
  const std::string& path_;
  FaultList& faults_;
  YamlReader& reader_;
  std::optional<Fields> fields_;
};

}  // namespace poinsot
