#include "poinsot/cli/verbs.h"

#include <iostream>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/cli/connect.h"
#include "poinsot/program/signals.h"

namespace poinsot {
namespace {

// The program's options, and the action of the verb that was named.
struct CommandLine {
  CommandLine()
      : app("Client of poinsotd: watch, push and control a running simulation.", "poinsot") {
    set_plain_help(app);
    add_version_option(app);
    app.require_subcommand(1);
    app.footer(exit_code_help() + "\nEach verb has its own --help.");
    for (const Verb& verb : kVerbs) add(verb);
  }

  void add(const Verb& verb) {
    CLI::App* const sub = app.add_subcommand(std::string(verb.name), std::string(verb.summary));
    sub->group("Verbs");
    const Action action = verb.declare(*sub);
    sub->callback([this, action] { chosen = action; });
    if (verb.on_bus) add_connection_options(*sub, flags);
    add_verbose_option(*sub, verbosity);
    sub->footer("Example:\n  " + std::string(verb.example));
  }

  CLI::App app;
  ConnectionFlags flags;
  int verbosity = 0;
  Action chosen;
};

// Turns a signal that asks for the end into a token, in a thread of its own.
class StopListener {
 public:
  StopListener()
      : thread_([this] {
          signals_.wait();
          source_.request_stop();
        }) {}
  ~StopListener() { signals_.request_stop(); }
  StopListener(const StopListener&) = delete;
  StopListener& operator=(const StopListener&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  StopSignals signals_;
  std::stop_source source_;
  std::jthread thread_;
};

int fail(ExitCode code, const char* what) {
  std::cerr << "poinsot: " << what << "\n";
  return to_int(code);
}

}  // namespace

int run_client(int argc, const char* const* argv) {
  CommandLine line;
  if (const auto code = parse_command_line(line.app, argc, argv, std::cout, std::cerr))
    return *code;
  StopListener listener;  // before any other thread
  try {
    const Context context{line.flags, make_logger("poinsot", spdlog::level::warn, line.verbosity),
                          listener.token()};
    return to_int(line.chosen(context));
  } catch (const Stopped&) {
    return to_int(ExitCode::ok);
  } catch (const Error& error) {
    return fail(ExitCode::usage, error.what());
  } catch (const std::exception& error) {
    return fail(ExitCode::failure, error.what());
  }
}

}  // namespace poinsot
