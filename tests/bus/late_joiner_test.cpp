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

TEST(LateJoiner, DoesNotGetABodyThatIsForgotten) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<BodyInfo> scene(here, "removed");
  Subscriber<BodyInfo> early(there, "removed");
  for (std::uint32_t i = 0; i < 3; ++i) ASSERT_TRUE(scene.write(sample::body_info(i, 1)));
  BodyInfo body;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(eventually([&] { return early.take(body); }));
  BodyInfo gone;
  gone.id = sample::body_info(1, 1).id;
  gone.removed = true;
  ASSERT_TRUE(scene.write(gone));
  ASSERT_TRUE(eventually([&] { return early.take(body); }));
  EXPECT_TRUE(body.removed);
  EXPECT_EQ(body.id, gone.id);

  ASSERT_TRUE(scene.forget(gone));
  Subscriber<BodyInfo> late(there, "removed");
  for (const std::uint32_t i : {0u, 2u}) {
    ASSERT_TRUE(eventually([&] { return late.take(body); }));
    EXPECT_EQ(body.id, sample::body_info(i, 1).id);
    EXPECT_FALSE(body.removed);
  }
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
