#include "poinsot/cli/record.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/cli/send.h"

namespace poinsot {
namespace {

// The daemon's program: the one beside this one, or else whichever a shell would find.
std::string daemon_program() {
  std::error_code error;
  const auto self = std::filesystem::canonical("/proc/self/exe", error);
  const auto beside = self.parent_path() / "poinsotd";
  return !error && std::filesystem::is_regular_file(beside, error) ? beside.string() : "poinsotd";
}

[[noreturn]] void become(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // The new program is to get the signals that this one has kept for itself.
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
  execvp(arguments.front(), arguments.data());
  throw std::runtime_error(words.front() + ": " + std::strerror(errno));
}

}  // namespace

void add_record_options(CLI::App& app, RecordOptions& options) {
  CLI::Option* const name =
      app.add_option("name", options.name, "what to call the log")->type_name("NAME");
  app.add_flag("--stop", options.stop, "end the log that is written")->excludes(name);
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

RunControl to_control(const RecordOptions& options) {
  if (options.name.empty() && !options.stop)
    throw Error("nothing to do: give the log's NAME, or --stop to end the one that is written");
  return {.action = ControlAction::record, .name = options.name};
}

Action declare_record(CLI::App& app) {
  const auto options = std::make_shared<RecordOptions>();
  add_record_options(app, *options);
  return [options](const Context& context) {
    return send(context, to_control(*options), options->json);
  };
}

Action declare_replay(CLI::App& app) {
  const auto file = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  app.add_option("file", *file, "the log")->required()->type_name("FILE");
  app.add_flag("--json", *json, "print the outcome as a JSON object");
  return [file, json](const Context&) -> ExitCode {
    std::vector<std::string> command = {daemon_program(), "replay", *file};
    if (*json) command.push_back("--json");
    become(std::move(command));
  };
}

}  // namespace poinsot
