#include "poinsot/base/names.h"

#include <array>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(EditDistance, CountsSingleEdits) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("mass", "mass"), 0u);
  EXPECT_EQ(edit_distance("mas", "mass"), 1u);
  EXPECT_EQ(edit_distance("mazs", "mass"), 1u);
  EXPECT_EQ(edit_distance("amss", "mass"), 1u);  // neighbours swapped
  EXPECT_EQ(edit_distance("", "mass"), 4u);
}

TEST(NearestName, FindsTheMisspeltKey) {
  constexpr std::array<std::string_view, 4> keys = {"position", "orientation", "density", "mass"};
  EXPECT_EQ(nearest_name("postion", keys), "position");
  EXPECT_EQ(nearest_name("dnesity", keys), "density");
  EXPECT_EQ(nearest_name("weight_of_the_thing", keys), "");
  EXPECT_EQ(did_you_mean("postion", keys), ", did you mean 'position'?");
  EXPECT_EQ(did_you_mean("x", keys), "");
}

}  // namespace
}  // namespace poinsot
