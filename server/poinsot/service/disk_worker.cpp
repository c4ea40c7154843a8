#include "poinsot/service/disk_worker.h"

#include <cstdint>
#include <utility>

namespace poinsot {

DiskWorker::DiskWorker() : thread_([this] { run(); }) {}

bool DiskWorker::post(Job job) {
  return post(std::move(job), kCapacity);
}

bool DiskWorker::post_always(Job job) {
  return post(std::move(job), SIZE_MAX);
}

bool DiskWorker::has_room() {
  const std::lock_guard lock(mutex_);
  return !stopping_ && jobs_.size() < kCapacity;
}

bool DiskWorker::post(Job job, std::size_t capacity) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || jobs_.size() >= capacity) return false;
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
