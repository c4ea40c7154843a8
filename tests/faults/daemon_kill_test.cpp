// The daemon killed at random points with clients attached: what it leaves in shared memory is gone
// once the next one has started, and its clients go on with that one.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "faults/scene.h"
#include "support/temp_path.h"
#include "support/test_domain.h"

namespace poinsot::faults {
namespace {

using Clock = std::chrono::steady_clock;
using Files = std::set<std::string>;

// Rounds: some in a test, more by hand.
int rounds() {
  const char* wanted = std::getenv("POINSOT_FAULT_ROUNDS");
  return wanted != nullptr ? std::atoi(wanted) : 10;
}

// The segment and the queue that a process has for itself are those that no other living process
// had before it came: all that it maps, less those.
Files files_of(pid_t process) {
  const std::string shm = "/dev/shm/";
  Files files;
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  for (std::string line; std::getline(maps, line);)
    if (const auto at = line.find(shm); at != std::string::npos) {
      const std::string name = line.substr(at + shm.size());
      for (const std::string& file : {name, name + "_el", name + "_sl", "sem." + name + "_mutex"})
        files.insert(file);
    }
  return files;
}

Files existing(const Files& files) {
  Files left;
  for (const std::string& file : files)
    if (std::filesystem::exists("/dev/shm/" + file)) left.insert(file);
  return left;
}

Files without(Files files, const Files& others) {
  for (const std::string& file : others) files.erase(file);
  return files;
}

TEST(DaemonKilled, AtRandomPointsLeavesNothingBehindAndItsClientsGoOn) {
  const Witness witness(test_domain(), kWorld);
  std::optional<ChildProcess> holder;
  std::mt19937 random(20);
  Files left_behind;
  double longest = 0;  // [s] from the start of a daemon to its first frame at the witness
  std::uint64_t session = 0;
  for (int round = 0; round < rounds(); ++round) {
    const auto start = Clock::now();
    std::optional<Daemon> daemon(std::in_place, kWorld);
    ASSERT_TRUE(eventually([&] { return witness.session() != session && witness.frame() > 0; }))
        << round;
    longest = std::max(longest, std::chrono::duration<double>(Clock::now() - start).count());
    session = witness.session();
    if (!holder)
      holder.emplace(POINSOT_FAULT_CLIENT, Words{"hold", std::to_string(test_domain()), kWorld});
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 600));
    expect_undisturbed(witness, 1);

    Files clients = files_of(getpid());
    clients.merge(files_of(holder->id()));
    const Files own = without(files_of(daemon->id()), clients);
    daemon->signal(SIGKILL);
    EXPECT_EQ(daemon->wait(), 128 + SIGKILL);
    EXPECT_EQ(existing(left_behind), Files{}) << round;
    left_behind = own;
  }
  std::printf("%d rounds; a new daemon's frames were there after %.2f s at the most\n", rounds(),
              longest);
}

// The daemon that a supervisor runs.
pid_t child_of(pid_t supervisor) {
  const std::string id = std::to_string(supervisor);
  pid_t child = 0;
  std::ifstream("/proc/" + id + "/task/" + id + "/children") >> child;
  return child;
}

TEST(DaemonKilled, UnderASupervisorGoesOnFromItsLastCheckpoint) {
  // A supervisor gives up after five failures in ten seconds.
  constexpr std::uint64_t kFramesBetween = 150;
  constexpr std::uint64_t kAutosave = 60;  // frames
  const std::string data = test::make_temp_directory();
  const Daemon daemon(kWorld, {"--supervise", "--autosave", "1s", "--data", data});
  const Witness witness(test_domain(), kWorld);
  std::mt19937 random(20);
  std::vector<double> took;  // [s] from the end of a daemon to the next one's first frame
  std::uint64_t from = 0;
  for (int round = 0; round < (rounds() + 2) / 3; ++round) {
    const std::uint64_t until = from + kFramesBetween + random() % kAutosave;
    ASSERT_TRUE(eventually([&] { return witness.frame() > until; })) << round;
    const std::uint64_t session = witness.session(), reached = witness.frame();
    const pid_t child = child_of(daemon.id());
    ASSERT_GT(child, 0);
    const auto killed = Clock::now();
    ASSERT_EQ(kill(child, SIGKILL), 0);
    ASSERT_TRUE(eventually([&] { return witness.session() != session; })) << round;
    took.push_back(std::chrono::duration<double>(Clock::now() - killed).count());
    from = witness.seen().begin()->first;
    EXPECT_LE(from, reached + 1);
    // Not from the start: from a checkpoint of the last second or, if that was not complete, of the
    // one before; and what the witness missed while it met the newcomer.
    EXPECT_GT(from + 3 * kAutosave, reached) << round;
    ASSERT_TRUE(eventually([&] { return witness.frame() > from + 30; }));
    expect_undisturbed(witness, 30);
    std::printf("killed at frame %llu, goes on at %llu after %.2f s\n",
                static_cast<unsigned long long>(reached), static_cast<unsigned long long>(from),
                took.back());
  }
  std::filesystem::remove_all(data);
}

}  // namespace
}  // namespace poinsot::faults
