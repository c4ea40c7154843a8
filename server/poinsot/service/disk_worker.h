// Disk worker: one thread that does what may wait for a disk, in the order asked for. The queue is
// bounded; a job that finds no room is refused at once. Jobs do not throw.

#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace poinsot {

class DiskWorker {
 public:
  using Job = std::function<void()>;
  static constexpr std::size_t kCapacity = 64;  // jobs that wait

  DiskWorker();
  ~DiskWorker() { stop(); }
  DiskWorker(const DiskWorker&) = delete;
  DiskWorker& operator=(const DiskWorker&) = delete;

  // From any thread. False: full, or stopped; the job is dropped.
  bool post(Job job);
  // The same for the few that must not be done by who posts: beyond the capacity as well.
  bool post_always(Job job);
  bool has_room();
  // Does what is queued, and ends the thread.
  void stop();

 private:
  bool post(Job job, std::size_t capacity);
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace poinsot
