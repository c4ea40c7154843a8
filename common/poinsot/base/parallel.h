// The one door to threads of the physics: a fixed team that shares out independent tasks. Who does
// which task is left to chance; tasks must not depend on it, nor on one another.
//
// Nobody waits for a helper that has not begun: where the machine has no processor to spare the
// caller's thread does all by itself.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <span>
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
    run_stages(std::span(&count, 1),
               [&task](std::size_t, std::size_t k, int thread) { task(k, thread); });
  }

  // Many short stages, one after another: calls task(stage, k, thread) for k = 0 …
  // counts[stage] − 1; all that a stage has written is seen in the next one. Threads spin between
  // stages, for which a turn costs about a microsecond; but not for long.
  template <class Task>
  void run_stages(std::span<const std::size_t> counts, const Task& task) {
    if (helpers_.empty() || !is_shared(counts)) {
      for (std::size_t stage = 0; stage < counts.size(); ++stage)
        for (std::size_t k = 0; k < counts[stage]; ++k) task(stage, k, 0);
      return;
    }
    run(Job{[](const void* self, std::size_t stage, std::size_t k, int thread) {
              (*static_cast<const Task*>(self))(stage, k, thread);
            },
            &task, counts});
  }

 private:
  struct Job {
    void (*call)(const void* task, std::size_t stage, std::size_t k, int thread) = nullptr;
    const void* task = nullptr;
    std::span<const std::size_t> counts;
  };
  static bool is_shared(std::span<const std::size_t> counts);
  void run(const Job& job);
  void help(int thread);
  void work(const Job& job, int thread);
  void wait_for(std::size_t done) const;

  std::vector<std::thread> helpers_;
  std::mutex mutex_;
  std::condition_variable start_, done_helping_;
  Job job_;
  std::atomic<std::size_t> round_{0};  // of jobs
  int busy_ = 0;                       // helpers that are at the job
  bool open_ = false;                  // others may join
  std::atomic<bool> stop_{false};
  // Tasks of all stages, counted through: begun, and done.
  alignas(64) std::atomic<std::size_t> next_{0};
  alignas(64) std::atomic<std::size_t> done_{0};
};

}  // namespace poinsot
