#include "poinsot/study/export.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;
using Json = nlohmann::ordered_json;

StudyResult with_skipped() {
  StudyResult result = test::full_result();
  result.skipped = {test::setting(rk4, 1e-5)};
  return result;
}

TEST(Csv, HasAsManyFieldsInEveryRowAsInItsTitle) {
  std::istringstream text(to_csv(with_skipped()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1 + with_skipped().rows.size() + 1);
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const std::string& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
  EXPECT_TRUE(lines.back().ends_with(",skipped"));
}

TEST(Csv, KeepsAllDigitsOfErrors) {
  const double error = 1.0 / 3;
  const std::string csv =
      to_csv(test::result({test::row(test::setting(rk4, 0.1), {error, 0}, 2.5)}));
  EXPECT_NE(csv.find("\nrk4,1/10 s,0.10000000000000001,,0.33333333333333331,0,"), std::string::npos)
      << csv;
}

TEST(Json, IsOneObjectWithEveryRow) {
  const StudyResult result = with_skipped();
  const Json json = Json::parse(to_json(result, 0));
  EXPECT_EQ(json["scene"], "top_spin");
  EXPECT_EQ(json["horizon"], 10.0);
  EXPECT_EQ(json["rows"].size(), result.rows.size());
  EXPECT_EQ(json["rows"][0]["integrator"], "exact");
  EXPECT_EQ(json["rows"][0]["tolerance"], 0.0);
  EXPECT_FALSE(json["rows"][0].contains("step"));
  EXPECT_TRUE(json["rows"][0]["below_certificate"]["orientation"].get<bool>());
  EXPECT_EQ(json["reference"]["certificate"]["position"], 1e-12);
  EXPECT_EQ(json["reference"]["ends_by"], "asked");
  EXPECT_EQ(json["skipped"][0]["setting"], "1/100000 s");
  EXPECT_FALSE(json.contains("cheapest"));
}

TEST(Json, NamesTheCheapestIfAnErrorIsWanted) {
  EXPECT_EQ(Json::parse(to_json(test::full_result(), 1e-6))["cheapest"]["integrator"], "exact");
  EXPECT_TRUE(Json::parse(to_json(test::full_result(), 1e-13))["cheapest"].is_null());
}

TEST(Json, OfARunThatFlewApartCanBeParsed) {
  const StudyResult result = test::result({test::row(test::setting(rk4, 0.1), {INFINITY, 0}, 1)});
  EXPECT_TRUE(Json::parse(to_json(result, 0))["rows"][0]["position_error"].is_null());
}

TEST(Json, HasTheImpactSearches) {
  StudyResult result = test::full_result();
  EXPECT_TRUE(Json::parse(to_json(result, 0))["impact_searches"].empty());
  result.searches.resize(1);
  result.searches[0].impacts = 3;
  const Json row = Json::parse(to_json(result, 0))["impact_searches"][0];
  EXPECT_EQ(row["search"], "conservative");
  EXPECT_EQ(row["per_second"]["impacts"], 3);
}

}  // namespace
}  // namespace poinsot
