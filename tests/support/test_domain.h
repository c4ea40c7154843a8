// A private place on the bus for each test process, and bounded waiting.
//
// Processes that run at the same time never share a domain: each holds a file lock for its own,
// which the kernel drops with the process. Children are told the domain by their parent.

#pragma once

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace poinsot {

// The first free domain of 100 … 229, starting at a place that depends on the process.
inline int claim_test_domain() {
  constexpr int kFirst = 100;
  constexpr int kCount = 130;
  for (int i = 0; i < kCount; ++i) {
    const int domain = kFirst + (getpid() * 7 + i) % kCount;
    const auto path = std::filesystem::temp_directory_path() /
                      ("poinsot_test_domain_" + std::to_string(domain) + ".lock");
    const int file = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0) return domain;  // held until exit
    if (file >= 0) close(file);
  }
  throw std::runtime_error("no free test domain");
}

inline int test_domain() {
  static const int domain = claim_test_domain();
  return domain;
}

// Every wait of a bus test is bounded by this, far above what it takes on a busy machine.
inline constexpr std::chrono::seconds kPatience{20};

// Polls until `condition` holds; false if it does not within `timeout`.
template <class Condition>
bool eventually(Condition condition, std::chrono::nanoseconds timeout = kPatience) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace poinsot
