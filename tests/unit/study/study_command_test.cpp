#include "poinsot/study/study_command.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/study/gnuplot.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

Scene tumbling() {
  BodyDef body = test::free_body("body", 2, Vec3(1, 2, 3));
  body.angular_velocity = Vec3(1, 3, 2);
  return test::scene({body});
}

StudyOptions short_study() {
  StudyOptions options;
  options.frames = 12;
  options.budget = std::chrono::seconds(2);
  return options;
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(StudyCommand, PrintsTheTableAndWritesTheFilesAskedFor) {
  StudyOptions options = short_study();
  options.error = 1e-3;
  options.csv = test::temp_path("study.csv");
  options.svg = test::temp_path("it's a study.svg");
  StopSignals signals;
  std::ostringstream out;
  run_study(tumbling(), options, signals, out);
  EXPECT_NE(out.str().find("12 frames of 12"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("Cheapest"), std::string::npos);
  EXPECT_EQ(text_of(options.csv).rfind("integrator,setting,", 0), 0u);
  EXPECT_NE(text_of(options.svg).find("</svg>"), std::string::npos);
}

TEST(StudyCommand, ChecksItsFilesBeforeItBegins) {
  StudyOptions options = short_study();
  options.csv = "/nonexistent/study.csv";
  StopSignals signals;
  std::ostringstream out;
  EXPECT_THROW(run_study(tumbling(), options, signals, out), Error);
  EXPECT_EQ(out.str(), "");
}

TEST(StudyCommand, PassesErrorsOfTheWorkOn) {
  StopSignals signals;
  std::ostringstream out;
  EXPECT_THROW(run_study(test::scene({test::floor()}), short_study(), signals, out), Error);
}

// No double can tell a tenth of this.
TEST(StudyCommand, FailsWhereThereIsNoReference) {
  StudyOptions options = short_study();
  options.error = 1e-18;
  StopSignals signals;
  std::ostringstream out;
  EXPECT_THROW(run_study(tumbling(), options, signals, out), std::runtime_error);
  EXPECT_EQ(out.str(), "");
  options.json = true;
  StopSignals again;
  EXPECT_THROW(run_study(tumbling(), options, again, out), std::runtime_error);
  EXPECT_NE(out.str().find("\"frames\":0"), std::string::npos) << out.str();
}

TEST(StudyCommand, EndsWhenAskedToAndSaysSo) {
  StudyOptions options = short_study();
  options.frames = 100'000'000;
  options.budget = std::chrono::hours(1);
  options.svg = test::temp_path("nothing.svg");
  StopSignals signals;
  signals.request_stop();
  std::ostringstream out;
  run_study(tumbling(), options, signals, out);
  EXPECT_NE(out.str().find("Interrupted"), std::string::npos) << out.str();
  EXPECT_FALSE(std::filesystem::exists(options.svg)) << "there was nothing to draw";
}

TEST(Gnuplot, ThatIsMissingIsAnErrorThatNamesThePackage) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  std::string message;
  try {
    require_gnuplot();
  } catch (const Error& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
}

}  // namespace
}  // namespace poinsot
