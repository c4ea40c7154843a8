// What killed processes leave in shared memory goes; what belongs to running ones stays.

#include <filesystem>
#include <fstream>
#include <set>
#include <signal.h>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/participant.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/child_process.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using Files = std::set<std::string>;

// The files in shared memory that belong to a process: what it maps, their locks and semaphores.
Files files_of(pid_t process) {
  const std::string shm = "/dev/shm/";
  Files files;
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto at = line.find(shm);
    if (at == std::string::npos) continue;
    const std::string name = line.substr(at + shm.size());
    for (const std::string& file : {name, name + "_el", name + "_sl", "sem." + name + "_mutex"})
      if (std::filesystem::exists(shm + file)) files.insert(file);
  }
  return files;
}

Files existing(const Files& files) {
  Files left;
  for (const std::string& file : files)
    if (std::filesystem::exists("/dev/shm/" + file)) left.insert(file);
  return left;
}

TEST(StaleSegments, OfKilledProcessesAreRemoved) {
  for (int round = 0; round < 10; ++round) {
    ChildProcess child(role("idle", "stale"));
    ASSERT_EQ(child.read_line(), "ready");
    const Files files = files_of(child.id());
    ASSERT_EQ(files.size(), 5u);  // a segment, a queue, their locks, the queue's semaphore
    child.signal(SIGKILL);
    child.wait();
    ASSERT_EQ(existing(files), files);  // nobody else tidied up
    EXPECT_GE(remove_stale_segments(), static_cast<int>(files.size()));
    EXPECT_EQ(existing(files), Files{});
  }
}

TEST(StaleSegments, ADeadReadersQueueIsRemovedThoughItsWriterHoldsIt) {
  Participant participant({.domain = test_domain(), .bodies = 10});
  Publisher<PoseSnapshot> poses(participant, "held");
  const Files ours = files_of(getpid());
  ChildProcess reader(role("read_poses", "held", 1000));
  ASSERT_EQ(reader.read_line(), "ready");
  ASSERT_TRUE(eventually([&] { return poses.readers() == 1; }));
  ASSERT_TRUE(poses.write(sample::poses(1, 10)));
  ASSERT_EQ(reader.read_line(), "1 10 good");
  Files files = files_of(reader.id());
  for (const std::string& file : ours) files.erase(file);
  ASSERT_EQ(files.size(), 5u);
  ASSERT_GT(files_of(getpid()).size(), ours.size());  // we hold its queue
  reader.signal(SIGKILL);
  reader.wait();
  remove_stale_segments();
  EXPECT_EQ(existing(files), Files{});
}

TEST(StaleSegments, OfRunningProcessesStay) {
  Participant participant({.domain = test_domain()});
  ChildProcess child(role("serve", "alive"));
  ASSERT_EQ(child.read_line(), "ready");
  Subscriber<PoseSnapshot> poses(participant, "alive");
  PoseSnapshot snapshot;
  ASSERT_TRUE(eventually([&] { return poses.take(snapshot); }));
  Files files = files_of(child.id());
  files.merge(files_of(getpid()));
  remove_stale_segments();
  EXPECT_EQ(existing(files), files);
  const std::uint64_t frame = snapshot.frame;
  EXPECT_TRUE(eventually([&] { return poses.take(snapshot) && snapshot.frame > frame + 20; }));
}

}  // namespace
}  // namespace poinsot
