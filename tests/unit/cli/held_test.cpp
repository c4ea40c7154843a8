#include "poinsot/cli/held.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "unit/cli/sample.h"

namespace poinsot {
namespace {

constexpr std::uint64_t kMe = 0xAB;

HeldList held() {
  HeldList list;
  list.epoch = 2;
  list.frame = 60;
  HeldItem weight;
  weight.body = sample::kBox;
  weight.force = {0, -0.0, -3};
  weight.first_frame = 1;
  weight.last_frame = kForever;
  HeldItem drag;
  drag.client = kMe;
  drag.seq = 5;
  drag.slot = 0x80000001;
  drag.body = sample::kBall;
  drag.kind = WrenchKind::tether;
  drag.target = {1, 2, 3};
  drag.stiffness = 50;
  drag.damping = 20;
  drag.first_frame = 61;
  drag.last_frame = 120;
  list.items = {weight, drag};
  return list;
}

TEST(HeldText, SaysWhoHoldsWhatOnWhichBody) {
  const HeldList list = held();
  const Roster roster(sample::bodies(), {});
  const std::string text = held_text({list, roster, kMe, 60});
  for (const char* words :
       {"scene            -      box                  1-               force (0, 0, -3) N",
        "you              drag   big ball             61-120           tether to (1, 2, 3) m, 50 "
        "N/m, 20 N s/m, at (0, 0, 0) m, ends with its client"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
  HeldList nothing;
  nothing.frame = 7;
  EXPECT_EQ(held_text({nothing, roster, kMe, 60}), "frame 7: nothing is held\n");
}

TEST(HeldJson, HasANullForWhatHasNoEndAndNoSlot) {
  const HeldList list = held();
  const Roster roster(sample::bodies(), {});
  const auto json = nlohmann::json::parse(held_json({list, roster, kMe, 60}));
  EXPECT_EQ(json["frame"], 60);
  ASSERT_EQ(json["held"].size(), 2u);
  const auto& weight = json["held"][0];
  EXPECT_EQ(weight["client"], "scene");
  EXPECT_TRUE(weight["last_frame"].is_null());
  EXPECT_TRUE(weight["slot"].is_null());
  EXPECT_EQ(weight["force"].dump(), "[0.0,0.0,-3.0]");
  const auto& drag = json["held"][1];
  EXPECT_EQ(drag["client"], "00000000000000ab");
  EXPECT_TRUE(drag["you"]);
  EXPECT_EQ(drag["kind"], "tether");
  EXPECT_EQ(drag["target"].dump(), "[1.0,2.0,3.0]");
  EXPECT_FALSE(drag.contains("force"));
  EXPECT_EQ(drag["start_time"], 1.0);
}

}  // namespace
}  // namespace poinsot
