#include "poinsot/study/table.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/study/pareto.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;

// Columns of a line of UTF-8.
std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string line_with(const std::string& text, const std::string& word) {
  for (const std::string& line : lines_of(text))
    if (line.find(word) != std::string::npos) return line;
  return {};
}

TEST(Table, FitsAHundredColumnsWhateverTheNumbers) {
  StudyResult result = test::full_result();
  Row wild = test::row(test::setting(semi_implicit_euler, 1. / 3840), {1.234e300, 3.14159}, 1.2e9);
  wild.energy_error = wild.momentum_error = 1.234e-300;
  wild.cost.contact = 12345.678;
  result.rows.push_back(wild);
  for (const Row& row : result.rows) result.skipped.push_back(row.setting);
  mark_pareto(result);
  for (const std::string& line : lines_of(to_text(result))) EXPECT_LE(width(line), 100u) << line;
}

TEST(Table, HasRowsThatEndInTheSameColumn) {
  const std::string text = to_text(test::full_result());
  const std::size_t expected = width(line_with(text, "exact"));
  for (const char* name : {"taylor", "dop853", "dopri5", "rk4", "semi_implicit_euler"})
    EXPECT_EQ(width(line_with(text, std::string("   ") + name)), expected) << name;
}

TEST(Table, ShowsErrorsBelowTheCertificateAsBounds) {
  const StudyResult result = test::result({test::row(test::setting(rk4, 0.1), {3e-4, 1e-15}, 5)});
  const std::string line = line_with(to_text(result), "rk4");
  EXPECT_NE(line.find("0.0003"), std::string::npos) << line;
  EXPECT_NE(line.find("≤ 2e-13"), std::string::npos) << line;
}

TEST(Table, RoundsACertificateUp) {
  StudyResult result = test::result({});
  result.reference.certificate = {1.11e-12, 0};
  EXPECT_NE(reference_text(result).find("agree to 1.2e-12 m and 0 rad"), std::string::npos)
      << reference_text(result);
}

TEST(Table, MarksTheParetoRowsAndTheScenesOwn) {
  StudyResult result = test::full_result();
  mark_pareto(result);
  result.rows[1].setting.of_the_scene = true;
  const std::string text = to_text(result);
  EXPECT_EQ(line_with(text, "exact").substr(0, 2), "* ");
  EXPECT_EQ(line_with(text, "   taylor").substr(0, 2), "  ");
  EXPECT_NE(text.find(" > taylor"), std::string::npos);
}

TEST(Table, SaysWhatIsLeftOutAndWhy) {
  StudyResult result = test::full_result();
  result.rows[0].equal = {"1e-3", "1e-6"};
  result.rows[2].quarantined = 4;
  result.skipped = {test::setting(rk4, 1e-5)};
  const std::string text = to_text(result);
  EXPECT_NE(text.find("Same states as exact default: 1e-3, 1e-6\n"), std::string::npos) << text;
  EXPECT_NE(text.find(result.rows[2].setting.name() + " (4)"), std::string::npos) << text;
  EXPECT_NE(line_with(text, "Skipped").find("rk4 1/100000 s"), std::string::npos) << text;
  EXPECT_EQ(text.find("Interrupted"), std::string::npos);
}

TEST(ReferenceText, SaysWhereTheHorizonIsAndWhy) {
  StudyResult result = test::result({});
  EXPECT_NE(reference_text(result).find("up to t = 10 s, as asked for"), std::string::npos);
  result.horizon = 192;
  result.reference.end = HorizonEnd::disagreement;
  EXPECT_NE(reference_text(result).find("A reference exists up to t = 3.2 s"), std::string::npos);
  result.reference.end = HorizonEnd::budget;
  EXPECT_NE(reference_text(result).find("--budget"), std::string::npos);
  result.horizon = 0;
  result.reference.end = HorizonEnd::disagreement;
  EXPECT_NE(reference_text(result).find("No reference exists"), std::string::npos);
}

TEST(ReferenceText, WarnsIfTheMethodsAreOne) {
  StudyResult result = test::result({});
  EXPECT_EQ(reference_text(result).find("share a method"), std::string::npos);
  result.reference.independent = false;
  EXPECT_NE(reference_text(result).find("share a method"), std::string::npos);
}

TEST(Table, ShowsImpactSearchesIfAnythingMet) {
  StudyResult result = test::full_result();
  EXPECT_EQ(to_text(result).find("impact search"), std::string::npos);
  result.searches.resize(2);
  result.searches[1].search = ImpactSearchKind::backtracking;
  result.searches[1].of_the_scene = true;
  result.searches[1].difference = {0.125, 0.25};
  result.searches[1].poses = 4321;
  const std::string text = to_text(result);
  const std::size_t row = text.find(" > backtracking");
  ASSERT_NE(row, std::string::npos);
  const std::string line = text.substr(row, text.find('\n', row) - row);
  for (const char* word : {"0.12", "0.25", "4321"}) EXPECT_NE(line.find(word), std::string::npos);
}

TEST(CheapestText, NamesTheSettingOrSaysThatThereIsNone) {
  const StudyResult result = test::full_result();
  EXPECT_NE(cheapest_text(result, 1e-6).find("exact default"), std::string::npos);
  EXPECT_NE(cheapest_text(result, 1e-6).find("1e-06 m and 1e-06 rad"), std::string::npos);
  EXPECT_NE(cheapest_text(result, 1e-13).find("No setting"), std::string::npos);
}

}  // namespace
}  // namespace poinsot
