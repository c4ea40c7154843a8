// The end of a process, asked for from outside or within: SIGINT, SIGTERM and SIGHUP become an
// event that main waits for; no code runs in a signal handler.
//
//   StopSignals signals;             // first in main, before any thread is started
//   std::jthread worker([&] { work(); signals.request_stop(); });
//   signals.wait();

#pragma once

#include <chrono>
#include <csignal>

namespace poinsot {

class StopSignals {
 public:
  // Blocks the signals in this thread and all that it starts later, and ignores SIGPIPE: a closed
  // pipe is then an error of the write. A SIGHUP that the parent ignores (nohup) stays ignored.
  StopSignals();
  ~StopSignals();  // as it was
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Waits for a signal or request_stop(). A stop is remembered: later calls return at once.
  void wait();
  // The same for at most `timeout`; false on time-out.
  bool wait_for(std::chrono::nanoseconds timeout);

  // The signal that asked for the stop; 0 if none did. For the thread that waits.
  int signal() const { return signal_; }

  void request_stop();  // from any thread

 private:
  bool poll(const timespec* timeout);

  sigset_t mask_before_{};
  void (*pipe_before_)(int) = nullptr;
  int signal_fd_ = -1;
  int request_fd_ = -1;
  int signal_ = 0;
  bool stopped_ = false;
};

}  // namespace poinsot
