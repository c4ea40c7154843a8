// poinsot hz: how often samples of a topic come, how evenly, and how many are lost.

#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "poinsot/base/names.h"
#include "poinsot/cli/context.h"
#include "poinsot/cli/spread.h"

namespace poinsot {

enum class MeteredTopic { poses, report, events, contacts };
inline constexpr std::array<Named<MeteredTopic>, 4> kMeteredTopicNames = {{
    {"poses", MeteredTopic::poses},
    {"report", MeteredTopic::report},
    {"events", MeteredTopic::events},
    {"contacts", MeteredTopic::contacts},
}};

struct HzOptions {
  MeteredTopic topic = MeteredTopic::poses;
  std::uint64_t count = 0;  // end after so many lines; 0: when asked
  bool json = false;
};

void add_hz_options(CLI::App& app, HzOptions& options);

// `lost`: since the beginning; nothing for a topic without numbers.
std::string hz_text(std::string_view topic, const ArrivalMeter::Report& report,
                    std::optional<std::uint64_t> lost);
std::string hz_json(std::string_view topic, const ArrivalMeter::Report& report,
                    std::optional<std::uint64_t> lost);

Action declare_hz(CLI::App& app);

}  // namespace poinsot
