// A progress bar on a terminal: one line of stderr, redrawn in place and removed at the end. On
// anything else nothing.

#pragma once

#include <chrono>
#include <string>

namespace poinsot {

// "[#########           ]  45 %  rk4 1/240 s", as wide as `columns` allow. done: 0 … 1.
std::string progress_line(double done, const std::string& what, std::size_t columns = 79);

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  // removes it
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double done, const std::string& what);

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point last_{};
  std::string what_;
};

}  // namespace poinsot
