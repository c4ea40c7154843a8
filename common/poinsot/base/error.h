// Bad input from outside: a scene, an option, the environment. Thrown while loading, caught in main
// only, where it becomes exit code 2. The text is complete: it names the file, line and column or
// the option, what is wrong, and the nearest valid word. Several faults of one file are one Error
// with one line each.

#pragma once

#include <stdexcept>

namespace poinsot {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace poinsot
