#include "poinsot/service/disk_worker.h"

#include <chrono>
#include <future>
#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(DiskWorker, DoesEverythingInOrderBeforeItEnds) {
  std::vector<int> done;
  DiskWorker worker;
  for (int n = 0; n < 20; ++n) EXPECT_TRUE(worker.post([&done, n] { done.push_back(n); }));
  worker.stop();
  ASSERT_EQ(done.size(), 20u);
  for (int n = 0; n < 20; ++n) EXPECT_EQ(done[static_cast<std::size_t>(n)], n);
  EXPECT_FALSE(worker.post([] {}));
}

TEST(DiskWorker, RefusesAtOnceWhatFindsNoRoom) {
  DiskWorker worker;
  std::promise<void> begun, disk;
  ASSERT_TRUE(worker.post([&] {
    begun.set_value();
    disk.get_future().wait();  // a disk that hangs
  }));
  begun.get_future().wait();
  for (std::size_t n = 0; n < DiskWorker::kCapacity; ++n) ASSERT_TRUE(worker.post([] {}));
  EXPECT_FALSE(worker.post([] {}));
  disk.set_value();
}

TEST(DiskWorker, WhatMustNotBeDroppedFindsRoomInAFullQueue) {
  bool done = false;
  {
    DiskWorker worker;
    std::promise<void> begun, disk;
    worker.post([&] {
      begun.set_value();
      disk.get_future().wait();
    });
    begun.get_future().wait();
    while (worker.has_room()) worker.post([] {});
    EXPECT_TRUE(worker.post_always([&] { done = true; }));
    disk.set_value();
    worker.stop();
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace poinsot
