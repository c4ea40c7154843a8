#include "poinsot/program/parse.h"

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

std::string vector_error(std::string_view text) {
  try {
    parse_vector(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseVector, ReadsThreeNumbers) {
  EXPECT_EQ(parse_vector("1,2,3"), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(parse_vector("-1.5,+2e3,.25"), Eigen::Vector3d(-1.5, 2000, 0.25));
  EXPECT_EQ(parse_vector(" 0, 0 , 50 "), Eigen::Vector3d(0, 0, 50));
}

TEST(ParseVector, SaysWhatIsExpected) {
  EXPECT_EQ(vector_error("5,6"),
            "'5,6' is not a vector: expected three numbers x,y,z, like 0,0,50");
}

TEST(ParseVector, RefusesWhatIsNotThreeFiniteNumbers) {
  for (const char* text : {"", "a,b,c", "1,2,3,4", "1,,3", "1,2,3m", "1;2;3", "+-1,0,0", "0 0 50"})
    EXPECT_NE(vector_error(text), "accepted") << text;
  EXPECT_EQ(vector_error("0,nan,0"), "'0,nan,0' is not finite");
  EXPECT_EQ(vector_error("0,0,-inf"), "'0,0,-inf' is not finite");
}

TEST(ParseOrientation, ScalesToAUnitQuaternionInTheOrderXyzw) {
  const Eigen::Quaterniond q = parse_orientation("0, 0, 3, 4");
  EXPECT_EQ(q.z(), 0.6);
  EXPECT_EQ(q.w(), 0.8);
  for (const char* text : {"", "0,0,1", "0,0,0,0", "0,0,0,nan", "1,2,3,4,5"})
    EXPECT_THROW(parse_orientation(text), Error) << text;
}

TEST(ParseDuration, ReadsEveryUnit) {
  EXPECT_EQ(parse_duration("0.5s"), 500ms);
  EXPECT_EQ(parse_duration("200ms"), 200ms);
  EXPECT_EQ(parse_duration("3"), 3s);
  EXPECT_EQ(parse_duration("50us"), 50us);
  EXPECT_EQ(parse_duration("7ns"), 7ns);
  EXPECT_EQ(parse_duration("2min"), 2min);
  EXPECT_EQ(parse_duration("1.5 h"), 90min);
  EXPECT_EQ(parse_duration("0"), 0s);
}

TEST(ParseDuration, RoundsDecimalFractionsToTheNanosecond) {
  EXPECT_EQ(parse_duration("0.1s"), 100ms);
  EXPECT_EQ(parse_duration("0.3s"), 300ms);
  EXPECT_EQ(parse_duration("1.1ms"), 1100us);
}

TEST(ParseDuration, RefusesOtherWords) {
  for (const char* text : {"", "s", "soon", "1 day", "1s2", "-1s", "nan", "inf", "1e30h"})
    EXPECT_THROW(parse_duration(text), Error) << text;
}

}  // namespace
}  // namespace poinsot
