// The one door to threads of the physics: a fixed team that shares out independent tasks. Who does
// which task is left to chance; tasks must not depend on it, nor on one another.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace poinsot {

class Team {
 public:
  // The caller's thread is one of them.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  // Calls task(k, thread) for k = 0 … count − 1, with thread < size(), and returns when all are
  // done. One task, or a team of one, stays on the caller's thread.
  template <class Task>
  void run(std::size_t count, const Task& task) {
    if (helpers_.empty() || count < 2) {
      for (std::size_t k = 0; k < count; ++k) task(k, 0);
      return;
    }
    const Job job{[](const void* self, std::size_t k, int thread) {
                    (*static_cast<const Task*>(self))(k, thread);
                  },
                  &task, count};
    run(job);
  }

 private:
  struct Job {
    void (*call)(const void* task, std::size_t k, int thread) = nullptr;
    const void* task = nullptr;
    std::size_t count = 0;
  };
  void run(const Job& job);
  void help(int thread);
  void work(const Job& job, int thread);

  std::vector<std::thread> helpers_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  Job job_;
  std::size_t round_ = 0;  // of jobs
  int busy_ = 0;           // helpers
  bool stop_ = false;
  std::atomic<std::size_t> next_{0};
};

}  // namespace poinsot
