#include "poinsot/study/gnuplot.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "poinsot/base/error.h"

extern char** environ;

namespace poinsot {
namespace {

// A child with a standard input to write to and the given standard output.
class Child {
 public:
  Child(std::array<const char*, 3> arguments, int output) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
    const int error = spawn(arguments, ends[0], output);
    close(ends[0]);
    input_ = ends[1];
    if (error == 0) return;
    close(input_);
    if (error == ENOENT)
      throw Error(
          "there is no gnuplot to draw with: install the package gnuplot-nox, or ask for a "
          "table with --csv");
    throw std::runtime_error(std::string("cannot start gnuplot: ") + std::strerror(error));
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // False if the child does not listen.
  bool write_all(const std::string& text) const {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t n = write(input_, text.data() + at, text.size() - at);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return false;
      at += static_cast<std::size_t>(n);
    }
    return true;
  }

  // Ends the input and waits; true if the child was content.
  bool finish() const {
    close(input_);
    int status = 0;
    while (waitpid(id_, &status, 0) < 0)
      if (errno != EINTR) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  int spawn(std::array<const char*, 3> arguments, int input, int output) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    // The daemon blocks the signals that end it and ignores SIGPIPE; its children must not.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawnp(&id_, arguments[0], &files, &attributes,
                                   const_cast<char**>(arguments.data()), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
  }

  pid_t id_ = -1;
  int input_ = -1;
};

}  // namespace

void require_gnuplot() {
  std::FILE* const nowhere = std::fopen("/dev/null", "wb");
  if (nowhere == nullptr) throw std::runtime_error("cannot open /dev/null");
  const int output = fileno(nowhere);
  try {
    const Child child({"gnuplot", "--version", nullptr}, output);
    child.finish();
  } catch (...) {
    std::fclose(nowhere);
    throw;
  }
  std::fclose(nowhere);
}

void run_gnuplot(const std::string& script, std::FILE* output) {
  std::fflush(output);
  const Child child({"gnuplot", "-", nullptr}, fileno(output));
  const bool heard = child.write_all(script);
  if (!child.finish() || !heard) throw std::runtime_error("gnuplot failed on the plot");
}

}  // namespace poinsot
