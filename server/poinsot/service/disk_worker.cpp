#include "poinsot/service/disk_worker.h"

#include <utility>

namespace poinsot {

DiskWorker::DiskWorker() : thread_([this] { run(); }) {}

bool DiskWorker::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || jobs_.size() >= kCapacity) return false;
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
  return true;
}

void DiskWorker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void DiskWorker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const Job job = std::exchange(jobs_.front(), nullptr);
    jobs_.pop_front();
    lock.unlock();
    job();
    lock.lock();
  }
}

}  // namespace poinsot
