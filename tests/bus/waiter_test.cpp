#include <thread>

#include <gtest/gtest.h>

#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Bus {
  Participant here{{.domain = test_domain()}};
  Participant there{{.domain = test_domain()}};
  Publisher<Reply> reply{here, "waiter"};
  Publisher<RunReport> report{here, "waiter"};
  Subscriber<Reply> replies{there, "waiter"};
  Subscriber<RunReport> reports{there, "waiter"};
  Waiter waiter;

  Bus() {
    waiter.attach(replies);
    waiter.attach(reports);
    EXPECT_TRUE(eventually([&] {
      return reply.readers() == 1 && report.readers() == 1 && replies.writers() == 1 &&
             reports.writers() == 1;
    }));
  }
};

TEST(WaiterTest, TimesOutWithoutData) {
  Bus bus;
  const auto start = Clock::now();
  EXPECT_FALSE(bus.waiter.wait(50ms));
  EXPECT_GE(Clock::now() - start, 45ms);  // clocks of the two sides differ in resolution
  EXPECT_FALSE(bus.waiter.wait(-1ns));
}

TEST(WaiterTest, WakesForDataOfEitherSubscriber) {
  Bus bus;
  Reply reply;
  RunReport report;
  std::thread([&] { bus.report.write(sample::report()); }).join();
  EXPECT_TRUE(bus.waiter.wait(kPatience));
  EXPECT_TRUE(eventually([&] { return bus.reports.take(report); }));
  std::thread([&] { bus.reply.write(sample::reply()); }).join();
  EXPECT_TRUE(bus.waiter.wait(kPatience));
  EXPECT_TRUE(eventually([&] { return bus.replies.take(reply); }));
}

TEST(WaiterTest, DoesNotSleepWhileSamplesAreLeft) {
  Bus bus;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(bus.reply.write(sample::reply()));
  Reply reply;
  for (int taken = 0; taken < 3;) {
    ASSERT_TRUE(bus.waiter.wait(kPatience));
    taken += bus.replies.take(reply) ? 1 : 0;  // one for each wait
  }
}

TEST(WaiterTest, WakeEndsAWaitFromAnotherThreadAndBeforehand) {
  Bus bus;
  std::jthread waker([&] {
    std::this_thread::sleep_for(20ms);
    bus.waiter.wake();
  });
  EXPECT_TRUE(bus.waiter.wait(kPatience));
  bus.waiter.wake();
  EXPECT_TRUE(bus.waiter.wait(kPatience));
  EXPECT_FALSE(bus.waiter.wait(1ms));  // each wake counts once
}

}  // namespace
}  // namespace poinsot
