// poinsotd: runs, checks, studies or replays a scene. Options → scene → run → exit code.

#include <chrono>
#include <cstdlib>
#include <exception>
#include <future>
#include <iostream>
#include <thread>

#include "poinsot/base/error.h"
#include "poinsot/program/documentation.h"
#include "poinsot/program/exit_code.h"
#include "poinsot/program/log.h"
#include "poinsot/program/options.h"
#include "poinsot/program/signals.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/runner/load_scene.h"
#include "poinsot/runner/replay.h"
#include "poinsot/runner/run_offline.h"
#include "poinsot/study/study_command.h"
#ifdef POINSOT_BUS
#include "poinsot/service/client_command.h"
#include "poinsot/service/run_daemon.h"
#include "poinsot/service/supervisor.h"
#endif

namespace poinsot {
namespace {

struct Options {
  std::string scene = "push_me";
  BusFlags bus;
  std::string world;
  bool fast = false;
  double scale = 1;
  bool paused = false;
  bool offline = false;
  bool supervise = false;
  bool take_over = false;
  std::string data;
  std::string restore;
  std::chrono::nanoseconds autosave{};
  bool json = false;
  std::uint64_t frames = 0;
  std::string trajectory;
  std::string commands;
  std::string record;
  std::string log;
  int threads = 0;
  int verbosity = 0;
  StudyOptions study;
};

void add_threads(CLI::App& verb, Options& o) {
  verb.add_option("--threads", o.threads, "Threads of the physics (default: the scene's)")
      ->check(CLI::Range(1, 256));
}

CLI::App* add_run(CLI::App& app, Options& o) {
  CLI::App* run = app.add_subcommand("run", "Run a scene and serve it on the bus");
  run->add_option("scene", o.scene, "Scene file, or the name of a shipped scene")
      ->capture_default_str();
  add_bus_options(*run, o.bus);
  run->add_option("--world", o.world, "Name on the bus (default: the scene's)");
  run->add_flag("--take-over", o.take_over, "Serve the world though another daemon does");
  auto* fast =
      run->add_flag("--fast", o.fast, "Frames as fast as they can be advanced, not in real time");
  run->add_option("--scale", o.scale, "Simulated seconds per second; 0: as fast as it can")
      ->check(CLI::Range(0.0, kMaxTimeScale))
      ->capture_default_str()
      ->excludes(fast);
  run->add_option("--frames", o.frames, "End after so many frames")->check(CLI::PositiveNumber);
  run->add_flag("--paused", o.paused, "Start paused: wait for resume or step");
  run->add_flag("--offline", o.offline, "No bus and no pacing");
  run->add_option("--trajectory", o.trajectory, "Write every frame to this CSV file");
  run->add_option("--data", o.data,
                  "Directory of checkpoints and logs [environment variable POINSOT_DATA_DIR, or "
                  "~/.local/state/poinsot]");
  run->add_option(
      "--restore", o.restore,
      "Begin with this checkpoint; 'latest': the newest, or the scene if there is none");
  add_duration_option(*run, "--autosave", o.autosave,
                      "Checkpoint on disk so often; the last three are kept");
  run->add_flag("--supervise", o.supervise,
                "Start the daemon again when it fails, from the last autosave")
      ->excludes(run->get_option("--offline"));
  run->add_flag("--json", o.json, "Only the closing summary, as one line of JSON");
  run->add_option("--commands", o.commands, "Do what this command log says (--offline)");
  run->add_option("--record", o.record,
                  "Write a command log of this name; with --offline: to this file");
  add_threads(*run, o);
  add_verbose_option(*run, o.verbosity);
  return run;
}

CLI::App* add_replay(CLI::App& app, Options& o) {
  CLI::App* verb = app.add_subcommand(
      "replay", "Run a command log again and compare every frame, without a bus");
  verb->add_option("log", o.log, "Command log")->required();
  verb->add_option("--trajectory", o.trajectory, "Write every frame to this CSV file");
  verb->add_flag("--json", o.json, "The result as one line of JSON");
  add_threads(*verb, o);
  return verb;
}

CLI::App* add_check(CLI::App& app, Options& o) {
  CLI::App* check = app.add_subcommand("check", "Validate a scene file without running it");
  check->add_option("scene", o.scene, "Scene file, or the name of a shipped scene")->required();
  return check;
}

CLI::App* add_study(CLI::App& app, Options& o) {
  CLI::App* study = app.add_subcommand("study", "Speed against error of a scene, without a bus");
  study->add_option("scene", o.scene, "Scene file, or the name of a shipped scene")->required();
  add_study_options(*study, o.study);
  return study;
}

std::filesystem::path program() {
  return std::filesystem::canonical("/proc/self/exe");
}

// Installed beside the program, or in the source tree that it was built from.
std::filesystem::path scene_file(const std::string& scene) {
  const std::filesystem::path directories[] = {
      program().parent_path().parent_path() / POINSOT_DATA_DIR / "scenes", POINSOT_SOURCE_SCENES};
  return find_scene(scene, directories);
}

// Does the work on a thread of its own, which a signal stops.
template <class Work>
auto until_stopped(StopSignals& signals, const Work& work) {
  std::stop_source stop;
  std::packaged_task<decltype(work(stop.get_token()))()> task(
      [&] { return work(stop.get_token()); });
  auto result = task.get_future();
  std::jthread worker([&] {
    task();
    signals.request_stop();
  });
  signals.wait();
  stop.request_stop();
  return result.get();
}

void run_without_bus(Scene scene, const Options& o, StopSignals& signals) {
  if (o.paused) throw Error("--paused: nothing could resume a run that is --offline");
  const OfflineOptions options{
      .frames = o.frames, .trajectory = o.trajectory, .commands = o.commands, .record = o.record};
  const RunSummary summary = until_stopped(signals, [&](std::stop_token stop) {
    return run_offline(std::move(scene), options, std::move(stop));
  });
  std::cout << (o.json ? to_json(summary) : to_text(summary)) << std::flush;
}

ExitCode replay_log(const Options& o, StopSignals& signals) {
  const ReplayResult result = until_stopped(signals, [&](std::stop_token stop) {
    return replay(o.log, {.threads = o.threads, .trajectory = o.trajectory}, std::move(stop));
  });
  std::cout << (o.json ? to_json(result) : to_text(result)) << std::flush;
  return result.difference ? ExitCode::failure : ExitCode::ok;
}

#ifdef POINSOT_BUS
std::string search_path() {
  const char* const path = std::getenv("PATH");
  return path == nullptr ? std::string() : path;
}
#endif

void run(const Options& o, StopSignals& signals) {
  Scene scene = load_scene(scene_file(o.scene));
  if (o.threads != 0) scene.collision.threads = o.threads;
  if (o.offline) return run_without_bus(std::move(scene), o, signals);
  if (!o.commands.empty()) throw Error("--commands: needs --offline");
#ifdef POINSOT_BUS
  const DaemonOptions options{.domain = o.bus.domain,
                              .lan = o.bus.lan,
                              .partition = o.bus.partition,
                              .discovery_server = o.bus.discovery_server,
                              .world = o.world,
                              .take_over = o.take_over,
                              .scale = o.fast ? 0 : o.scale,
                              .paused = o.paused,
                              .frames = o.frames,
                              .client = client_command(program(), search_path()),
                              .trajectory = o.trajectory,
                              .data = o.data,
                              .restore = o.restore,
                              .record = o.record,
                              .autosave = o.autosave};
  const Logger logger = make_logger("poinsotd", spdlog::level::info, o.verbosity);
  run_daemon(std::move(scene), options, o.json, signals, logger, std::cout);
#else
  throw Error("this poinsotd was built without a bus (POINSOT_BUILD_BUS=OFF): add --offline");
#endif
}

#ifdef POINSOT_BUS
// The command line without --supervise. After a failure the world is free, whatever discovery still
// says, and the run goes on from where it was saved.
Supervision supervision(const Options& o, int argc, const char* const* argv) {
  Supervision result;
  result.first = {program().string()};
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]) != "--supervise") result.first.emplace_back(argv[i]);
  result.again = result.first;
  if (o.autosave.count() > 0) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < result.again.size(); ++i) {
      const std::string& word = result.again[i];
      if (word == "--restore") ++i;  // and its value
      if (!word.starts_with("--restore")) kept.push_back(word);
    }
    result.again = std::move(kept);
    result.again.insert(result.again.end(), {"--restore", kLatest});
  }
  if (!o.take_over) result.again.emplace_back("--take-over");
  return result;
}
#endif

void check(const Options& o) {
  const std::filesystem::path file = scene_file(o.scene);
  const Scene scene = load_scene(file);
  std::cout << file.string() << ": valid, " << scene.bodies.size() << " bodies\n";
}

int main_of(int argc, const char* const* argv) {
  StopSignals signals;  // before any thread
  CLI::App app("Poinsot: a multibody simulation service.", "poinsotd");
  set_plain_help(app);
  app.footer(exit_code_help());
  app.require_subcommand(1);
  add_version_option(app);
  Options options;
  const CLI::App* run_command = add_run(app, options);
  const CLI::App* study_command = add_study(app, options);
  const CLI::App* replay_command = add_replay(app, options);
  add_check(app, options);
  const DocumentationVerbs documentation(app, "poinsot(1)");
  if (const auto code = parse_command_line(app, argc, argv, std::cout, std::cerr)) return *code;
  if (const auto text = documentation.text()) {
    std::cout << *text;
    return to_int(ExitCode::ok);
  }
  try {
#ifdef POINSOT_BUS
    if (run_command->parsed() && options.supervise)
      return supervise(supervision(options, argc, argv),
                       make_logger("poinsotd", spdlog::level::info, options.verbosity));
#endif
    if (replay_command->parsed()) return to_int(replay_log(options, signals));
    if (run_command->parsed())
      run(options, signals);
    else if (study_command->parsed())
      run_study(load_scene(scene_file(options.scene)), options.study, signals, std::cout);
    else
      check(options);
    return to_int(ExitCode::ok);
  } catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return to_int(ExitCode::usage);
  } catch (const std::exception& error) {
    std::cerr << "poinsotd: " << error.what() << "\n";
    return to_int(ExitCode::failure);
  }
}

}  // namespace
}  // namespace poinsot

int main(int argc, char** argv) {
  return poinsot::main_of(argc, argv);
}
