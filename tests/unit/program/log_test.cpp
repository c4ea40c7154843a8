#include "poinsot/program/log.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using namespace std::chrono_literals;

TEST(Quoted, LeavesOneWordAsItIs) {
  EXPECT_EQ(quoted("push_me-1.5"), "push_me-1.5");
}

TEST(Quoted, KeepsALogEntryOnOneLineAndItsFieldsApart) {
  EXPECT_EQ(quoted(""), "\"\"");
  EXPECT_EQ(quoted("two words"), "\"two words\"");
  EXPECT_EQ(quoted("a=b"), "\"a=b\"");
  EXPECT_EQ(quoted("line\nbreak"), "\"line break\"");
  EXPECT_EQ(quoted("say \"x\\y\""), "\"say \\\"x\\\\y\\\"\"");
}

TEST(MakeLogger, GrowsMoreDetailedWithVerbosityAndStopsAtAll) {
  EXPECT_EQ(make_logger("x", spdlog::level::warn, 0)->level(), spdlog::level::warn);
  EXPECT_EQ(make_logger("x", spdlog::level::warn, 1)->level(), spdlog::level::info);
  EXPECT_EQ(make_logger("x", spdlog::level::info, 9)->level(), spdlog::level::trace);
}

TEST(MakeLogger, WritesLevelAndEventToStderrOnly) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const Logger logger = make_logger("x", spdlog::level::info, 0);
  logger->info("listening domain={}", 77);
  logger->debug("hidden");
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_NE(err.find(" info     listening domain=77\n"), std::string::npos) << err;
  EXPECT_EQ(err.find("hidden"), std::string::npos);
}

TEST(RepeatLimiter, LetsOneThroughPerIntervalAndCountsTheRest) {
  RepeatLimiter limiter(1s);
  const RepeatLimiter::Time start{};
  EXPECT_EQ(limiter.admit(start), 0u);
  EXPECT_EQ(limiter.admit(start + 1ms), std::nullopt);
  EXPECT_EQ(limiter.admit(start + 999ms), std::nullopt);
  EXPECT_EQ(limiter.admit(start + 1s), 2u);
  EXPECT_EQ(limiter.admit(start + 5s), 0u);
}

}  // namespace
}  // namespace poinsot
