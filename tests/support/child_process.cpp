#include "support/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "support/test_domain.h"

namespace poinsot {

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           Errors errors) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  if (errors == Errors::kept) errors_ = memfd_create("errors", MFD_CLOEXEC);
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  if (errors_ >= 0) posix_spawn_file_actions_adddup2(&actions, errors_, STDERR_FILENO);
  const int failed = posix_spawn(&id_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  output_ = pipe_ends[0];
  if (failed != 0) throw std::runtime_error("cannot start " + program);
}

ChildProcess::~ChildProcess() {
  if (id_ > 0) {
    signal(SIGKILL);
    wait();
  }
  close(output_);
  if (errors_ >= 0) close(errors_);
}

bool ChildProcess::read_more() {
  pollfd ready{.fd = output_, .events = POLLIN, .revents = 0};
  const auto patience = std::chrono::duration_cast<std::chrono::milliseconds>(kPatience);
  if (poll(&ready, 1, static_cast<int>(patience.count())) <= 0) return false;
  char text[4096];
  const ssize_t count = read(output_, text, sizeof text);
  if (count <= 0) return false;
  buffer_.append(text, static_cast<std::size_t>(count));
  return true;
}

std::string ChildProcess::read_line() {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (true) {
    if (const auto end = buffer_.find('\n'); end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    if (std::chrono::steady_clock::now() > until || !read_more()) return {};
  }
}

std::string ChildProcess::read_rest() {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < until && read_more()) continue;
  return std::exchange(buffer_, {});
}

std::string ChildProcess::errors() const {
  std::string text;
  char part[4096];
  for (ssize_t count = 0;
       (count = pread(errors_, part, sizeof part, static_cast<off_t>(text.size()))) > 0;)
    text.append(part, static_cast<std::size_t>(count));
  return text;
}

void ChildProcess::signal(int number) const {
  kill(id_, number);
}

int ChildProcess::wait() {
  int status = 0;
  if (!eventually([&] { return waitpid(id_, &status, WNOHANG) != 0; })) {
    kill(id_, SIGKILL);
    waitpid(id_, &status, 0);
  }
  id_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace poinsot
