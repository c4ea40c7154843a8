// What another process hears of impacts.

#include <cmath>

#include <gtest/gtest.h>

#include "system/programs.h"

namespace poinsot {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]

TEST(Events, TellEveryBounceOfABallAtItsTime) {
  // The elastic ball of the scene falls one metre, for ever.
  const Daemon daemon("bouncing_balls");
  Listener listener({"-n", "3", "--body", "ball_10"});
  const double speed = std::sqrt(2 * kGravity), period = 2 * speed / kGravity;
  double last = -1;
  for (int i = 0; i < 3; ++i) {
    const Json impact = listener.next();
    EXPECT_EQ(impact["a"]["name"], "ball_10");
    EXPECT_EQ(impact["b"]["name"], "ground");
    const auto time = impact["time"].get<double>();
    const double bounce = (time - speed / kGravity) / period;
    EXPECT_NEAR(bounce, std::round(bounce), 1e-9 * (1 + bounce));
    EXPECT_EQ(impact["frame"].get<double>(), std::ceil(time * 60));
    if (last >= 0) {
      EXPECT_NEAR(time - last, period, 1e-9);
    }
    last = time;
    // Heights are kept to 1e-9 m, and so are speeds.
    EXPECT_NEAR(impact["a"]["linear_before"][2].get<double>(), -speed, 1e-8);
    EXPECT_NEAR(impact["a"]["linear_after"][2].get<double>(), speed, 1e-8);
    EXPECT_NEAR(impact["normal"][2].get<double>(), 1, 1e-12);
    EXPECT_NEAR(impact["point"][2].get<double>(), 0, 1e-8);
    const double mass = 1000 * 4 / 3.0 * M_PI * 1e-3;
    EXPECT_NEAR(impact["impulse"][2].get<double>(), 2 * mass * speed, 1e-6);
  }
  EXPECT_EQ(listener.wait(), 0);
  EXPECT_EQ(listener.errors(), "");
}

TEST(Events, AreLinesForPeopleAndRefuseAnUnknownBody) {
  const Daemon daemon("bouncing_balls");
  const Ended lines = client({"events", "-n", "2"});
  EXPECT_EQ(lines.code, 0) << lines.errors;
  EXPECT_EQ(lines.out.substr(0, 15), "# frame time a ");
  EXPECT_NE(lines.out.find(" ground "), std::string::npos) << lines.out;
  const Ended unknown = client({"events", "--body", "ball_1"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.errors.find("did you mean"), std::string::npos) << unknown.errors;
}

}  // namespace
}  // namespace poinsot
