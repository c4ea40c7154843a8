#include "poinsot/program/signals.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

bool ignored_by_parent(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

sigset_t stop_set() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  if (!ignored_by_parent(SIGHUP)) sigaddset(&set, SIGHUP);
  return set;
}

}  // namespace

StopSignals::StopSignals() {
  const sigset_t set = stop_set();
  POINSOT_CHECK(pthread_sigmask(SIG_BLOCK, &set, &mask_before_) == 0);
  pipe_before_ = std::signal(SIGPIPE, SIG_IGN);
  signal_fd_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  request_fd_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  POINSOT_CHECK(signal_fd_ >= 0 && request_fd_ >= 0);
}

StopSignals::~StopSignals() {
  close(request_fd_);
  close(signal_fd_);
  std::signal(SIGPIPE, pipe_before_);
  pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

void StopSignals::wait() {
  while (!poll(nullptr)) {
  }
}

bool StopSignals::wait_for(std::chrono::nanoseconds timeout) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + timeout;
  while (true) {
    const auto left = std::max(std::chrono::nanoseconds::zero(),
                               std::chrono::nanoseconds(deadline - Clock::now()));
    const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
    const timespec time{.tv_sec = seconds.count(), .tv_nsec = (left - seconds).count()};
    if (poll(&time)) return true;
    if (left == std::chrono::nanoseconds::zero()) return false;
  }
}

void StopSignals::request_stop() {
  const std::uint64_t one = 1;
  // Fails only when the counter is full: then a request stands already.
  [[maybe_unused]] const auto written = write(request_fd_, &one, sizeof one);
}

bool StopSignals::poll(const timespec* timeout) {
  if (stopped_) return true;
  std::array<pollfd, 2> files{{{signal_fd_, POLLIN, 0}, {request_fd_, POLLIN, 0}}};
  const int ready = ppoll(files.data(), files.size(), timeout, nullptr);
  if (ready < 0) POINSOT_CHECK(errno == EINTR);
  if (ready <= 0) return false;
  signalfd_siginfo info{};
  if (read(signal_fd_, &info, sizeof info) == sizeof info)
    signal_ = static_cast<int>(info.ssi_signo);
  stopped_ = true;
  return true;
}

}  // namespace poinsot
