// Another process, whose standard output is read line by line and whose standard error can be kept.
// Every wait is bounded by kPatience. A child that is still there at the end is killed.

#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace poinsot {

class ChildProcess {
 public:
  enum class Errors { shown, kept };

  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               Errors errors = Errors::kept);
  // This program again, its errors shown.
  explicit ChildProcess(const std::vector<std::string>& arguments)
      : ChildProcess("/proc/self/exe", arguments, Errors::shown) {}
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The next line of its output; "" after kPatience or when the child has ended.
  std::string read_line();
  // All that is left of its output, until it ends.
  std::string read_rest();
  // What it wrote to standard error so far, if that is kept.
  std::string errors() const;
  void signal(int number) const;
  // Waits for the end; exit status as of the shell (128 + signal). A child that does not end is
  // killed: 137.
  int wait();

  pid_t id() const { return id_; }

 private:
  bool read_more();

  pid_t id_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::string buffer_;
};

}  // namespace poinsot
