#include "poinsot/service/supervisor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <deque>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "poinsot/program/exit_code.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array kPassedOn = {SIGINT, SIGTERM, SIGHUP};
constexpr int kCouldNotStart = 127;  // as of a shell

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  for (const int signal : kPassedOn) sigaddset(&set, signal);
  return set;
}

// Between fork and exec only what is safe in a signal handler.
[[noreturn]] void become(char* const* arguments, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);  // it ended meanwhile
  const sigset_t set = watched_signals();
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
  execv(arguments[0], arguments);
  _exit(kCouldNotStart);
}

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(arguments.data(), parent);
  return child;
}

struct End {
  int status = 0;     // of wait()
  bool told = false;  // to end, by a signal that was passed on
};

// Waits for the child's end, passing signals on.
End wait_for(pid_t child) {
  const sigset_t set = watched_signals();
  End end;
  while (waitpid(child, &end.status, WNOHANG) != child) {
    siginfo_t info{};
    const int signal = sigwaitinfo(&set, &info);
    if (signal < 0 || signal == SIGCHLD) continue;
    end.told = true;
    // What comes from a terminal has come to the child as well.
    if (info.si_code != SI_KERNEL) kill(child, signal);
  }
  return end;
}

int exit_code(const End& end) {
  if (WIFEXITED(end.status)) return WEXITSTATUS(end.status);
  return to_int(end.told ? ExitCode::ok : ExitCode::failure);
}

// A mistake on the command line shows at the first start; later the same code says that the world
// around is not as it was, the bus for one, and may be again.
bool ended_well(const End& end, bool failed_before) {
  if (end.told) return true;
  if (!WIFEXITED(end.status)) return false;
  const int code = WEXITSTATUS(end.status);
  return code == to_int(ExitCode::ok) || code == kCouldNotStart ||
         (code == to_int(ExitCode::usage) && !failed_before);
}

std::string how(int status) {
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

int supervise(const Supervision& supervision, const Logger& logger) {
  const sigset_t set = watched_signals();
  sigset_t before;
  sigprocmask(SIG_BLOCK, &set, &before);
  std::deque<Clock::time_point> failures;
  const std::vector<std::string>* command = &supervision.first;
  while (true) {
    const End end = wait_for(start(*command));
    if (ended_well(end, command == &supervision.again)) {
      sigprocmask(SIG_SETMASK, &before, nullptr);
      return exit_code(end);
    }
    const Clock::time_point now = Clock::now();
    failures.push_back(now);
    while (now - failures.front() > supervision.within) failures.pop_front();
    if (static_cast<int>(failures.size()) >= supervision.failures) {
      logger->error("gave_up by={} failures={} within_s={}", poinsot::quoted(how(end.status)),
                    failures.size(), supervision.within.count());
      sigprocmask(SIG_SETMASK, &before, nullptr);
      return to_int(ExitCode::failure);
    }
    logger->error("restarts by={} failures={}", poinsot::quoted(how(end.status)), failures.size());
    command = &supervision.again;
  }
}

}  // namespace poinsot
