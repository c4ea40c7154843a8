#include "poinsot/base/parallel.h"

namespace poinsot {

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

void Team::run(const Job& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = job;
    next_ = 0;
    busy_ = static_cast<int>(helpers_.size());
    ++round_;
  }
  start_.notify_all();
  work(job, 0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return busy_ == 0; });
}

void Team::help(int thread) {
  std::size_t seen = 0;
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
      job = job_;
    }
    work(job, thread);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void Team::work(const Job& job, int thread) {
  for (std::size_t k = next_++; k < job.count; k = next_++) job.call(job.task, k, thread);
}

}  // namespace poinsot
