// What of this machine matters to the bus. Each check looks and says; none changes anything.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "poinsot/cli/findings.h"
#include "poinsot/program/options.h"

namespace poinsot {

Finding check_domain_choice(const BusFlags& flags);
Findings check_interfaces(const BusFlags& flags);
Findings check_ports(int domain);
Findings check_shared_memory();
Finding check_socket_buffers();
Finding check_profiles();

// Pure parts. Ports that the kernel gives to whoever asks for any, "32768\t60999\n".
std::optional<std::pair<int, int>> parse_port_range(std::string_view text);
Finding judge_port_range(int first, int last, std::pair<int, int> ephemeral);
Finding judge_shared_memory(std::uint64_t size, std::uint64_t free);
Finding judge_socket_buffers(std::uint64_t receive, std::uint64_t send);

}  // namespace poinsot
