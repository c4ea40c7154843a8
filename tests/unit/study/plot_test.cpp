#include "poinsot/study/plot.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/study/gnuplot.h"
#include "poinsot/study/pareto.h"
#include "support/temp_path.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

std::string drawn(const std::string& script) {
  const auto path = test::temp_path("plot.svg");
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  run_gnuplot(script, file);
  std::fclose(file);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Plot, IsAnSvgThatNamesEveryCurveTheFrontAndTheCertificate) {
  StudyResult result = test::full_result();
  mark_pareto(result);
  const std::string svg = drawn(plot_script(result));
  EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  for (const char* word : {"exact", "taylor", "dop853", "dopri5", "rk4", "semi_implicit_euler",
                           "Pareto front", "certificate", "top_spin", "1/3840 s"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
}

TEST(Plot, DrawsErrorsOfZeroAndOfRunsThatFlyApart) {
  StudyResult result =
      test::result({test::row(test::setting(IntegratorKind::exact, 0), {}, 5),
                    test::row(test::setting(IntegratorKind::explicit_euler, 0.01), {1e300, 3}, 4)});
  result.reference.certificate = {};
  mark_pareto(result);
  const std::string svg = drawn(plot_script(result));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("certificate"), std::string::npos);
}

TEST(Gnuplot, ThatComplainsIsAnError) {
  EXPECT_THROW(drawn("no such command\n"), std::runtime_error);
}

}  // namespace
}  // namespace poinsot
