#include "poinsot/scene/yaml_reader.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

// The value of `v` read as a number; the fault, if there is one, in `fault`.
std::optional<double> number(const std::string& text, std::string* fault = nullptr) {
  const YamlTree tree = parse_yaml("v: " + text, "s.yaml");
  FaultList faults("s.yaml");
  const auto value = YamlReader(faults).number(*tree.root->entries[0].second, "v");
  EXPECT_EQ(value.has_value(), faults.sorted().empty());
  if (fault && !value) *fault = faults.sorted()[0].where + ": " + faults.sorted()[0].what;
  return value;
}

TEST(YamlReader, ReadsDecimalNumbersToTheLastBit) {
  EXPECT_EQ(number("1"), 1.0);
  EXPECT_EQ(number("-0.5"), -0.5);
  EXPECT_EQ(number("+2"), 2.0);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5.0);
  EXPECT_EQ(number("1e-3"), 1e-3);
  EXPECT_EQ(number("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(number("0.1000000000000000055511151231257827"), 0.1);
  EXPECT_EQ(number("0"), 0.0);
  EXPECT_EQ(number("0.0"), 0.0);
}

TEST(YamlReader, RefusesWhatOnlyLooksLikeANumber) {
  for (const char* text :
       {".nan",  "nan",  ".inf",  "-.inf",  "inf",    "infinity", "0x10",  "0o17", "017",
        "-017",  "00",   "1e400", "-1e400", "1_000",  "1:30",     "1,5",   "1 2",  "+-1",
        "-+1",   "--1",  "+",     ".",      "1e",     "1e+",      "1.2.3", "one",  "'1'",
        "\"1\"", "true", "~",     "[1]",    "{a: 1}", "1f",       "1d0",   "١"})
    EXPECT_EQ(number(text), std::nullopt) << text;
  std::string fault;
  number("  .nan", &fault);
  EXPECT_EQ(fault, "s.yaml:1:6: v must be a finite decimal number, is '.nan'");
  number("'1'", &fault);
  EXPECT_EQ(fault, "s.yaml:1:4: v must be a finite decimal number, is the quoted text '1'");
  number(std::string(1000, 'x'), &fault);
  EXPECT_LT(fault.size(), 200u);  // long values are not repeated in full
}

TEST(YamlReader, ReportsEachPlaceOnceAndInFileOrder) {
  const YamlTree tree = parse_yaml("- &n x\n- *n\n- y\n", "s.yaml");
  FaultList faults("s.yaml");
  YamlReader reader(faults);
  for (const std::size_t i : {2u, 0u, 1u}) reader.number(*tree.root->items[i], "v");
  const auto sorted = faults.sorted();
  ASSERT_EQ(sorted.size(), 2u);  // the alias is the anchor's place
  EXPECT_EQ(sorted[0].where, "s.yaml:1:3");
  EXPECT_EQ(sorted[1].where, "s.yaml:3:3");
}

TEST(YamlReader, RefusesAValueMultipliedByAliases) {
  // 3 000 × 3 000 × 1 000 points from a few kilobytes.
  std::string text = "- &p [1, 2, 3]\n- &q [*p";
  for (int i = 1; i < 3000; ++i) text += ", *p";
  text += "]\n- [*q";
  for (int i = 1; i < 3000; ++i) text += ", *q";
  const YamlTree tree = parse_yaml(text + "]\n", "s.yaml");
  FaultList faults("s.yaml");
  YamlReader reader(faults);
  EXPECT_ANY_THROW({
    for (const YamlNode* q : tree.root->items[2]->items)
      for (const YamlNode* p : q->items) reader.vector(*p, "v");
  });
}

TEST(YamlReader, CountsTheKeysOfATableEachTimeItIsRead) {
  const YamlTree tree = parse_yaml("{radius: 1, length: 2}", "s.yaml");
  FaultList faults("s.yaml");
  YamlReader reader(faults);
  int read = 0;
  const auto read_until_refused = [&] {
    for (;; ++read) reader.fields(*tree.root, "v", kRoundTable);
  };
  EXPECT_THROW(read_until_refused(), Error);
  EXPECT_EQ(read, 10'000'000 / 3);  // the table and its keys
}

TEST(FaultList, KeepsAThousandFaultsAndCountsTheRest) {
  FaultList faults("s.yaml");
  YamlNode node;
  for (node.line = 1; node.line <= 1500; ++node.line)
    for (int twice = 0; twice < 2; ++twice) faults.add(node, "bad");
  const auto sorted = faults.sorted();
  ASSERT_EQ(sorted.size(), FaultList::kMaxReported + 1);
  EXPECT_EQ(sorted.back().where, "s.yaml");
  EXPECT_EQ(sorted.back().what, "and 1000 more faults");  // what is not kept cannot be compared
}

}  // namespace
}  // namespace poinsot
