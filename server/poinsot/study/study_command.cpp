#include "poinsot/study/study_command.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <future>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "poinsot/base/error.h"
#include "poinsot/study/export.h"
#include "poinsot/study/gnuplot.h"
#include "poinsot/study/plot.h"
#include "poinsot/study/progress_bar.h"
#include "poinsot/study/sweep.h"
#include "poinsot/study/table.h"

namespace poinsot {
namespace {

using Seconds = std::chrono::duration<double>;

// Created before the work begins, so that a wrong path costs nobody half a minute.
class OutputFile {
 public:
  OutputFile(const std::string& option, const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_.reset(std::fopen(path.c_str(), "wb"));
    if (!file_) throw Error(option + ": cannot create '" + path + "': " + std::strerror(errno));
  }

  explicit operator bool() const { return file_ != nullptr; }
  std::FILE* get() { return file_.get(); }
  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), get()) != text.size()) fail();
  }
  void discard() {
    file_.reset();
    if (std::filesystem::is_regular_file(std::filesystem::symlink_status(path_)))
      std::filesystem::remove(path_);  // not /dev/stdout and the like
  }
  void close() {
    if (file_ && std::fclose(file_.release()) != 0) fail();
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail() const {
    throw std::runtime_error("cannot write '" + path_ + "': " + std::strerror(errno));
  }

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

SweepOptions sweep_options(const Scene& scene, const StudyOptions& options) {
  const double frames = Seconds(options.time).count() * scene.presentation.frame_rate;
  return {.frames = options.frames > 0
                        ? options.frames
                        : static_cast<std::uint64_t>(std::max(1LL, std::llround(frames))),
          .budget = options.budget,
          .wanted_error = options.error};
}

// The work on a thread of its own, while this one waits for signals.
StudyResult sweep_until_stopped(const Scene& scene, const SweepOptions& options,
                                StopSignals& signals) {
  ProgressBar bar;
  std::stop_source stop;
  std::packaged_task<StudyResult()> task([&] {
    const auto show = [&bar](double done, const std::string& what) { bar.show(done, what); };
    return sweep(scene, options, show, stop.get_token());
  });
  std::future<StudyResult> result = task.get_future();
  const std::jthread worker([&] {
    task();
    signals.request_stop();
  });
  signals.wait();
  stop.request_stop();
  return result.get();
}

}  // namespace

void add_study_options(CLI::App& app, StudyOptions& o) {
  CLI::Option* const frames =
      app.add_option("--frames", o.frames, "Study so many frames")->check(CLI::PositiveNumber);
  add_duration_option(app, "--time", o.time, "Study so much simulated time [10s]")
      ->excludes(frames);
  add_duration_option(app, "--budget", o.budget,
                      "Wall time that it may take: less is studied rather than more taken [30s]");
  app.add_option("--error", o.error,
                 "Name the cheapest setting with errors of at most so many m and rad")
      ->check(CLI::PositiveNumber);
  app.add_option("--csv", o.csv, "Write the table to this CSV file")->type_name("FILE");
  app.add_option("--svg", o.svg, "Draw the table into this SVG file; needs gnuplot")
      ->type_name("FILE");
  app.add_flag("--json", o.json, "One JSON object instead of the table");
}

void run_study(const Scene& scene, const StudyOptions& options, StopSignals& signals,
               std::ostream& out) {
  if (options.time.count() == 0) throw Error("--time: must be longer than 0 s");
  if (!std::isfinite(options.error)) throw Error("--error: must be a finite number > 0");
  if (options.budget.count() == 0) throw Error("--budget: must be longer than 0 s");
  if (!options.svg.empty()) require_gnuplot();
  OutputFile csv("--csv", options.csv);
  OutputFile svg("--svg", options.svg);
  const StudyResult result = sweep_until_stopped(scene, sweep_options(scene, options), signals);

  const bool has_reference = result.horizon > 0 || result.interrupted;
  if (options.json)
    out << to_json(result, options.error);
  else if (has_reference)
    out << to_text(result) << (options.error > 0 ? cheapest_text(result, options.error) : "");
  out << std::flush;
  if (csv) csv.write(to_csv(result));
  csv.close();
  if (result.rows.empty())
    svg.discard();  // there is nothing to draw
  else if (svg)
    run_gnuplot(plot_script(result), svg.get());
  svg.close();
  if (!has_reference) throw std::runtime_error(reference_text(result));
}

}  // namespace poinsot
