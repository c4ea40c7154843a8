#include "poinsot/scene/yaml_tree.h"

#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_yaml(text, "s.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(YamlTree, KeepsPlacesQuotesAndDuplicates) {
  const YamlTree tree = parse_yaml("a: 1\n\nb:\n  - x\n  - 'y'\na: ~\n", "s.yaml");
  const YamlNode& root = *tree.root;
  ASSERT_EQ(root.kind, YamlNode::Kind::map);
  ASSERT_EQ(root.entries.size(), 3u);
  EXPECT_EQ(root.entries[2].first->text, "a");  // the second one
  EXPECT_EQ(root.entries[2].first->line, 6);
  EXPECT_EQ(root.entries[2].second->kind, YamlNode::Kind::nothing);
  const YamlNode& list = *root.entries[1].second;
  ASSERT_EQ(list.items.size(), 2u);
  EXPECT_EQ(list.items[1]->text, "y");
  EXPECT_TRUE(list.items[1]->quoted);
  EXPECT_FALSE(list.items[0]->quoted);
  EXPECT_EQ(list.items[1]->line, 5);
  EXPECT_EQ(list.items[1]->column, 5);
}

TEST(YamlTree, SharesTheNodeOfAnAnchor) {
  const YamlTree tree = parse_yaml("a: &s {box: 1}\nb: *s\n", "s.yaml");
  EXPECT_EQ(tree.root->entries[0].second, tree.root->entries[1].second);
}

TEST(YamlTree, RefusesWhatIsNotOneDocument) {
  EXPECT_EQ(refusal(""), "s.yaml:1:1: the scene file is empty");
  EXPECT_EQ(refusal("# nothing but a comment\n"), "s.yaml:1:1: the scene file is empty");
  EXPECT_EQ(refusal("a: 1\n---\nb: 2\n"), "s.yaml:2:1: a scene file must be one YAML document");
  EXPECT_EQ(refusal("a: [1, 2\n"), "s.yaml:2:1: YAML: end of sequence flow not found");
  EXPECT_EQ(refusal("a: 1\n b: 2\n"), "s.yaml:2:3: YAML: illegal map value");
  EXPECT_EQ(refusal("a: *nobody\n"), "s.yaml:1:4: YAML: the referenced anchor is not defined");
  EXPECT_EQ(refusal("a: !!float 1\n"), "s.yaml:1:4: tags ('tag:yaml.org,2002:float') have no use");
}

TEST(YamlTree, SurvivesHostileText) {
  EXPECT_EQ(refusal("a: &a [*a]\n"), "s.yaml:1:8: an alias must not stand inside its own anchor");
  EXPECT_EQ(refusal("a: " + std::string(1 << 20, '[')),
            "s.yaml:1:1004: more than 1000 open brackets");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "- ";
  EXPECT_EQ(refusal(deep), "s.yaml:1:129: nested deeper than 64 levels");
  std::string lines;
  for (int i = 0; i < 3000; ++i) lines += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_EQ(refusal(lines), "s.yaml:65:65: nested deeper than 64 levels");
  EXPECT_EQ(refusal("a: 1\nb: \x04 2\n"), "s.yaml:2:4: control character 4");
  EXPECT_EQ(refusal(std::string("a: \0", 4)), "s.yaml:1:4: control character 0");
  EXPECT_EQ(refusal(std::string((32u << 20) + 1, ' ')),
            "s.yaml: a scene file must not be longer than 33554432 bytes");
}

TEST(YamlTree, CountsAliasesAsValues) {
  std::string text = "- &a 1\n- [*a";
  for (int i = 0; i < 5'000'000; ++i) text += ",*a";
  const std::string error = refusal(text + "]\n");
  EXPECT_NE(error.find("s.yaml:2:"), std::string::npos) << error;
  EXPECT_NE(error.find("must not hold more than 5000000 values"), std::string::npos) << error;
}

}  // namespace
}  // namespace poinsot
