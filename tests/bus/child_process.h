// This test program again, as another process: `roles.h` says what it does there. Its standard
// output is read line by line, with a bounded wait. A child that is still there at the end is
// killed.

#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace poinsot {

class ChildProcess {
 public:
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The next line; "" after kPatience or when the child has ended.
  std::string read_line();
  void signal(int number) const;
  // Waits for the end; exit status as of the shell (128 + signal).
  int wait();

  pid_t id() const { return id_; }

 private:
  pid_t id_ = -1;
  int output_ = -1;
  std::string buffer_;
};

}  // namespace poinsot
