#include "poinsot/wire/stream_name.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

TEST(StreamName, AFilterSurvivesItsSuffix) {
  for (const PoseFilter& filter :
       {PoseFilter{.match = "box*"}, PoseFilter{.rate = 0.1}, PoseFilter{.change = 0.0},
        PoseFilter{.match = "a_1,b-?,Körper 7", .rate = 30, .change = 1e-3}}) {
    const std::string suffix = stream_suffix(filter);
    const auto back = parse_stream_suffix(suffix);
    ASSERT_TRUE(back) << suffix;
    EXPECT_EQ(*back, filter) << suffix;
    EXPECT_TRUE(std::ranges::all_of(suffix, [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '/';
    })) << suffix;
  }
}

TEST(StreamName, AllBodiesInEveryFrameHaveNoSuffix) {
  EXPECT_EQ(stream_suffix({}), "");
  EXPECT_FALSE(parse_stream_suffix(""));
}

TEST(StreamName, TheDocumentedNameIsUnderstood) {
  const auto filter = parse_stream_suffix("rate/10/change/0_2e001/match/box_2a");
  ASSERT_TRUE(filter);
  EXPECT_EQ(*filter, (PoseFilter{.match = "box*", .rate = 10, .change = 0.001}));
}

TEST(StreamName, NonsenseIsRefused) {
  for (const char* suffix :
       {"rate", "rate/", "rate/0", "rate/1e_2d300", "rate/_2d1", "rate/nan", "rate/1e400",
        "rate/10/rate/10", "match/a/rate/10", "match/", "match/_", "match/_2", "match/_zz",
        "match/_00", "change/x", "colour/red", "match/a/b", "/"})
    EXPECT_FALSE(parse_stream_suffix(suffix)) << suffix;
  EXPECT_FALSE(parse_stream_suffix("match/" + std::string(kMaxStreamSuffix, 'a')));
}

TEST(StreamName, WhatCannotBeAskedForIsAnError) {
  EXPECT_THROW(stream_suffix(PoseFilter{.rate = -1}), Error);
  EXPECT_THROW(stream_suffix(PoseFilter{.change = std::numeric_limits<double>::quiet_NaN()}),
               Error);
  EXPECT_THROW(stream_suffix(PoseFilter{.match = std::string(kMaxStreamSuffix, 'a')}), Error);
}

TEST(StreamName, PatternsMatchWholeNames) {
  EXPECT_TRUE(matches("", "anything"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("box*", "box12"));
  EXPECT_TRUE(matches("*a*b", "xxaybzb"));
  EXPECT_TRUE(matches("b?x", "box"));
  EXPECT_TRUE(matches("a,b", "b"));
  EXPECT_FALSE(matches("box", "box1"));
  EXPECT_FALSE(matches("b?x", "bx"));
  EXPECT_FALSE(matches("*a*b", "xxaybz"));
  EXPECT_FALSE(matches("a,b", "a,b"));
}

// A pattern of many stars against a long name must not take exponential time.
TEST(StreamName, ManyStarsAreQuick) {
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "a*";
  EXPECT_FALSE(matches(pattern + "b", std::string(100, 'a')));
}

}  // namespace
}  // namespace poinsot
