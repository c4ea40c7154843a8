#include "poinsot/cli/hz.h"

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/json_line.h"
#include "poinsot/cli/output.h"
#include "poinsot/client/loss_counter.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kInterval = 1s;  // of a line

class Meter {
 public:
  Meter(const Context& context, const HzOptions& options)
      : options_(options),
        client_(options.topic == MeteredTopic::poses ? connect(context, PoseFilter{})
                                                     : connect_to_listen(context)) {}

  ExitCode run() {
    const std::string_view topic = name_of<MeteredTopic>(kMeteredTopicNames, options_.topic);
    bool open = true;
    for (std::uint64_t line = 0; open && (options_.count == 0 || line < options_.count); ++line) {
      const auto until = Clock::now() + kInterval;
      while (Clock::now() < until)
        if (next(until - Clock::now())) arrivals_.add(Clock::now());
      const ArrivalMeter::Report report = arrivals_.take();
      open = put(options_.json ? hz_json(topic, report, lost()) : hz_text(topic, report, lost()));
    }
    return ExitCode::ok;
  }

 private:
  bool next(Client::Duration timeout) {
    switch (options_.topic) {
      case MeteredTopic::poses:
        return client_.next_poses(poses_, timeout);
      case MeteredTopic::report:
        return next_report(timeout);
      case MeteredTopic::events:
        if (!client_.next_impact(impact_, timeout)) return false;
        losses_.add(impact_.session, impact_.sequence);
        return true;
      case MeteredTopic::contacts:
        if (!client_.next_contacts(contacts_, timeout)) return false;
        losses_.add(contacts_.session, contacts_.sequence);
        return true;
    }
    return false;
  }

  bool next_report(Client::Duration timeout) {
    try {
      client_.report(timeout);
      return true;
    } catch (const NoAnswer&) {
      return false;
    }
  }

  std::optional<std::uint64_t> lost() const {
    if (options_.topic == MeteredTopic::report) return std::nullopt;
    return options_.topic == MeteredTopic::poses ? client_.lost_poses() : losses_.lost();
  }

  const HzOptions& options_;
  Client client_;
  ArrivalMeter arrivals_;
  LossCounter losses_;
  PoseSnapshot poses_;
  ImpactNotice impact_;
  ContactSnapshot contacts_;
};

}  // namespace

void add_hz_options(CLI::App& app, HzOptions& options) {
  add_choice_option<MeteredTopic>(app, "topic", options.topic, kMeteredTopicNames,
                                  "which one [poses]");
  app.add_option("-n,--count", options.count, "end after so many lines, one a second")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", options.json, "one JSON object a line");
}

std::string hz_text(std::string_view topic, const ArrivalMeter::Report& report,
                    std::optional<std::uint64_t> lost) {
  constexpr double kMs = 1e3;
  std::string text =
      fmt::format("{}: {:.2f} Hz, period p50 {:.3f}, p99 {:.3f}, max {:.3f} ms", topic, report.rate,
                  report.period.p50 * kMs, report.period.p99 * kMs, report.period.max * kMs);
  if (report.samples == 0) text = fmt::format("{}: nothing came", topic);
  return text + (lost ? fmt::format(", {} lost\n", *lost) : "\n");
}

std::string hz_json(std::string_view topic, const ArrivalMeter::Report& report,
                    std::optional<std::uint64_t> lost) {
  return json_line(
      {{"topic", topic},
       {"samples", report.samples},
       {"rate", report.rate},
       {"period",
        {{"p50", report.period.p50}, {"p99", report.period.p99}, {"max", report.period.max}}},
       {"lost", lost ? Json(*lost) : Json(nullptr)}});
}

Action declare_hz(CLI::App& app) {
  const auto options = std::make_shared<HzOptions>();
  add_hz_options(app, *options);
  return [options](const Context& context) { return Meter(context, *options).run(); };
}

}  // namespace poinsot
