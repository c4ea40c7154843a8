// The scene: one sample per body, kept for those who come later.

#include <set>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/child_process.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

constexpr std::uint32_t kBodies = 1000;

TEST(LateJoiner, InAnotherProcessGetsTheWholeScene) {
  Participant participant({.domain = test_domain(), .bodies = kBodies});
  Publisher<BodyInfo> scene(participant, "late");
  for (std::uint32_t i = 0; i < kBodies; ++i)
    ASSERT_TRUE(scene.write(sample::body_info(i, kBodies)));
  ChildProcess late(role("read_scene", "late", kBodies));
  EXPECT_EQ(late.read_line(), std::to_string(kBodies));
  EXPECT_EQ(late.wait(), 0);
}

TEST(LateJoiner, GetsTheNewestSampleOfEachBody) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<BodyInfo> scene(here, "newest");
  for (const char* name : {"old", "new"})
    for (std::uint32_t i = 0; i < 10; ++i) {
      BodyInfo body = sample::body_info(i, 10);
      body.name = name;
      ASSERT_TRUE(scene.write(body));
    }
  Subscriber<BodyInfo> late(there, "newest");
  std::multiset<std::uint32_t> slots;
  BodyInfo body;
  EXPECT_TRUE(eventually([&] {
    while (late.take(body)) {
      slots.insert(body.id.slot);
      EXPECT_EQ(body.name, "new");
    }
    return slots.size() >= 10;
  }));
  for (std::uint32_t i = 0; i < 10; ++i)
    EXPECT_EQ(slots.count(sample::body_info(i, 10).id.slot), 1u);
}

TEST(LateJoiner, GetsTheLastReport) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<RunReport> publisher(here, "report");
  RunReport report = sample::report();
  for (report.frame.frame = 1; report.frame.frame < 5; ++report.frame.frame)
    ASSERT_TRUE(publisher.write(report));
  Subscriber<RunReport> late(there, "report");
  ASSERT_TRUE(eventually([&] { return late.take(report); }));
  EXPECT_EQ(report.frame.frame, 4u);
}

}  // namespace
}  // namespace poinsot
