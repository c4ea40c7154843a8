#include "poinsot/base/parallel.h"

#include <algorithm>

namespace poinsot {
namespace {

// Looks at something that another thread is about to change, before it is worth sleeping: some tens
// of microseconds.
constexpr int kSpins = 1000;
// A helper looks for the next job longer: what a frame does between two of them takes a fraction of
// a millisecond, and waking up takes as long.
constexpr int kHelperSpins = 20000;

void pause() {
#ifdef __x86_64__
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

Team::Team(int threads) {
  for (int k = 1; k < threads; ++k) helpers_.emplace_back([this, k] { help(k); });
}

Team::~Team() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

bool Team::is_shared(std::span<const std::size_t> counts) {
  return std::ranges::any_of(counts, [](std::size_t count) { return count > 1; });
}

void Team::run(const Job& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = job;
    next_ = 0;
    done_ = 0;
    open_ = true;
    ++round_;
  }
  start_.notify_all();
  work(job, 0);
  std::unique_lock lock(mutex_);
  open_ = false;
  done_helping_.wait(lock, [&] { return busy_ == 0; });
}

void Team::help(int thread) {
  std::size_t seen = 0;
  while (true) {
    for (int spin = 0;
         spin < kHelperSpins && round_.load(std::memory_order_relaxed) == seen && !stop_; ++spin)
      pause();
    Job job;
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
      if (!open_) continue;
      job = job_;
      ++busy_;
    }
    work(job, thread);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_helping_.notify_one();
  }
}

void Team::work(const Job& job, int thread) {
  std::size_t stage = 0, before = 0;  // tasks of earlier stages
  std::size_t task = next_.load();
  while (true) {
    while (stage < job.counts.size() && task >= before + job.counts[stage])
      before += job.counts[stage++];
    wait_for(before);  // before taking a task: nobody shall wait for one who waits
    if (stage == job.counts.size()) return;
    if (!next_.compare_exchange_weak(task, task + 1)) continue;
    job.call(job.task, stage, task - before, thread);
    done_.fetch_add(1);
    done_.notify_all();
    task = next_.load();
  }
}

void Team::wait_for(std::size_t done) const {
  for (int spin = 0; spin < kSpins; ++spin) {
    if (done_.load() >= done) return;
    pause();
  }
  for (std::size_t seen = done_.load(); seen < done; seen = done_.load()) done_.wait(seen);
}

}  // namespace poinsot
