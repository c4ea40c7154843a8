#include "poinsot/scene/yaml_tree.h"

#include <sstream>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

constexpr std::size_t kMaxValues = 5'000'000;  // keys and aliases are values as well
constexpr std::size_t kMaxDepth = 64;          // a scene needs 8
constexpr int kMaxOpenInLine = 1000;           // brackets opened and not closed in one line

[[noreturn]] void fail(const std::string& file, int line, int column, const std::string& what) {
  throw Error(file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
}

class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& file, YamlTree& tree) : file_(file), tree_(tree) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) refuse(mark, "a scene file must be one YAML document");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode* node = add(YamlNode::Kind::nothing, mark, "", anchor);
    // yaml-cpp sees a missing value only at the next token; its key is the better place.
    const YamlNode* key = open_.empty() ? nullptr : open_.back().key;
    if (key && key->line != node->line) node->line = key->line, node->column = key->column;
    place(node);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    count(mark);
    const YamlNode* node = anchors_.at(anchor);
    for (const Open& open : open_)
      if (open.node == node) refuse(mark, "an alias must not stand inside its own anchor");
    place(node);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode* node = add(YamlNode::Kind::scalar, mark, tag, anchor);
    node->text = value;
    node->quoted = tag == "!";
    place(node);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(add(YamlNode::Kind::list, mark, tag, anchor), mark);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(add(YamlNode::Kind::map, mark, tag, anchor), mark);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode* node;
    const YamlNode* key;  // of a map: read, and waiting for its value
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& what) const {
    fail(file_, mark.line + 1, mark.column + 1, what);
  }

  void count(const YAML::Mark& mark) {
    if (++values_ > kMaxValues)
      refuse(mark,
             "a scene file must not hold more than " + std::to_string(kMaxValues) + " values");
  }

  YamlNode* add(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                YAML::anchor_t anchor) {
    if (!tag.empty() && tag != "?" && tag != "!") refuse(mark, "tags ('" + tag + "') have no use");
    count(mark);
    YamlNode& node = tree_.nodes.emplace_back();
    node.kind = kind;
    node.line = mark.line + 1;
    node.column = mark.column + 1;
    if (anchor != YAML::NullAnchor) {
      if (anchors_.size() <= anchor) anchors_.resize(anchor + 1);
      anchors_[anchor] = &node;
    }
    return &node;
  }

  void place(const YamlNode* node) {
    if (open_.empty()) {
      tree_.root = node;
    } else if (Open& parent = open_.back(); parent.node->kind == YamlNode::Kind::list) {
      parent.node->items.push_back(node);
    } else if (!parent.key) {
      parent.key = node;
    } else {
      parent.node->entries.emplace_back(parent.key, node);
      parent.key = nullptr;
    }
  }

  void open(YamlNode* node, const YAML::Mark& mark) {
    if (open_.size() >= kMaxDepth)
      refuse(mark, "nested deeper than " + std::to_string(kMaxDepth) + " levels");
    place(node);
    open_.push_back({node, nullptr});
  }
  void close() { open_.pop_back(); }

  const std::string& file_;
  YamlTree& tree_;
  std::vector<Open> open_;
  std::vector<const YamlNode*> anchors_;
  std::size_t values_ = 0;
  int documents_ = 0;
};

// What yaml-cpp does not survive or see: it takes byte 4 for the end of the text, lets other
// control characters pass, and holds a whole line of opening brackets in memory before it looks at
// depth.
void check_characters(std::string_view text, const std::string& file) {
  int line = 1, column = 1, open = 0;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if ((code < 0x20 && c != '\n' && c != '\r' && c != '\t') || code == 0x7f)
      fail(file, line, column, "control character " + std::to_string(code));
    open += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (open > kMaxOpenInLine)
      fail(file, line, column, "more than " + std::to_string(kMaxOpenInLine) + " open brackets");
    ++column;
    if (c == '\n') ++line, column = 1, open = 0;
  }
}

}  // namespace

YamlTree parse_yaml(std::string_view text, const std::string& file) {
  if (text.size() > kMaxYamlText)
    throw Error(file + ": a scene file must not be longer than " + std::to_string(kMaxYamlText) +
                " bytes");
  check_characters(text, file);
  YamlTree tree;
  TreeBuilder builder(file, tree);
  std::istringstream stream{std::string(text)};
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& e) {
    const bool placed = !e.mark.is_null();
    fail(file, placed ? e.mark.line + 1 : 1, placed ? e.mark.column + 1 : 1, "YAML: " + e.msg);
  }
  if (!tree.root) fail(file, 1, 1, "the scene file is empty");
  return tree;
}

}  // namespace poinsot
