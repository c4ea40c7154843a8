#include "poinsot/cli/host_checks.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <ifaddrs.h>
#include <iterator>
#include <map>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <spdlog/fmt/fmt.h>

#include "poinsot/wire/diagnosis.h"
#include "poinsot/wire/participant.h"

namespace poinsot {
namespace {

constexpr std::uint64_t kMegabyte = 1 << 20;
// A daemon's segment of shared memory, at most, and that of a client.
constexpr std::uint64_t kLargestSegment = 128 * kMegabyte;
constexpr std::uint64_t kSmallestSegment = 1 * kMegabyte;
// What the wire asks the kernel for; with less, large frames are sent again in parts.
constexpr std::uint64_t kSocketBuffer = 4 * kMegabyte;

std::string file_text(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::uint64_t number_in(const char* path) {
  const std::string text = file_text(path);
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

struct Interface {
  unsigned flags = 0;
  std::string addresses;
  bool is_up() const { return (flags & IFF_UP) != 0; }
  bool is_loopback() const { return (flags & IFF_LOOPBACK) != 0; }
  bool multicasts() const { return (flags & IFF_MULTICAST) != 0; }
};

std::map<std::string, Interface> interfaces() {
  std::map<std::string, Interface> found;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return found;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> list(first, freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    Interface& interface = found[entry->ifa_name];
    interface.flags = entry->ifa_flags;
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const void* const address = &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr;
    inet_ntop(AF_INET, address, text.data(), text.size());
    interface.addresses += (interface.addresses.empty() ? "" : ", ") + std::string(text.data());
  }
  return found;
}

bool can_bind(int port) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool bound =
      bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(descriptor);
  return bound;
}

}  // namespace

Finding check_domain_choice(const BusFlags& flags) {
  Finding finding{Health::ok, "domain", fmt::format("{}", flags.domain), {}};
  const char* const variable = std::getenv("POINSOT_DOMAIN_ID");
  if (variable != nullptr && *variable != '\0')
    finding.text += fmt::format(" (POINSOT_DOMAIN_ID is {})", variable);
  finding.text += flags.lan ? ", local network" : ", this host";
  if (!flags.partition.empty()) finding.text += ", partition " + flags.partition;
  if (!flags.discovery_server.empty())
    finding.text += ", discovery server " + flags.discovery_server;
  return finding;
}

Findings check_interfaces(const BusFlags& flags) {
  Findings findings;
  bool loopback = false, network = false;
  for (const auto& [name, interface] : interfaces()) {
    if (!interface.is_up() || interface.addresses.empty()) continue;
    (interface.is_loopback() ? loopback : network) = true;
    findings.push_back({Health::ok,
                        "interface",
                        fmt::format("{} {}, multicast {}", name, interface.addresses,
                                    interface.multicasts() ? "yes" : "no"),
                        {}});
    if (flags.lan && !interface.is_loopback() && !interface.multicasts())
      findings.back() = {
          Health::warn, "interface", findings.back().text,
          fmt::format("daemons are met by multicast: ip link set {} multicast on", name)};
  }
  if (!loopback)
    findings.push_back(
        {Health::fail, "interface", "no loopback interface is up", "ip link set lo up"});
  if (flags.lan && !network)
    findings.push_back({Health::fail, "interface", "no interface but loopback is up",
                        "without a network use --listen local"});
  return findings;
}

Findings check_ports(int domain) {
  const PortPlan plan = port_plan(domain);
  int taken = 0;
  for (const int port : plan.unicast) taken += !can_bind(port);
  const int all = static_cast<int>(plan.unicast.size());
  Finding use{
      Health::ok,
      "ports",
      fmt::format("UDP {} to {}, {} of {} in use", plan.multicast, plan.unicast.back(), taken, all),
      {}};
  if (taken == all) {
    use.health = Health::fail;
    use.advice = "no participant finds a place: end some, or take another --domain";
  }
  Findings findings = {use};
  if (const auto range = parse_port_range(file_text("/proc/sys/net/ipv4/ip_local_port_range")))
    findings.push_back(judge_port_range(plan.multicast, plan.unicast.back(), *range));
  return findings;
}

std::optional<std::pair<int, int>> parse_port_range(std::string_view text) {
  int first = 0, last = 0;
  const char* const end = text.data() + text.size();
  const auto low = std::from_chars(text.data(), end, first);
  const char* next = low.ptr;
  while (next != end && (*next == ' ' || *next == '\t')) ++next;
  const auto high = std::from_chars(next, end, last);
  if (low.ec != std::errc() || high.ec != std::errc()) return std::nullopt;
  return std::pair(first, last);
}

Finding judge_port_range(int first, int last, std::pair<int, int> ephemeral) {
  Finding finding{Health::ok, "port range", "no other program gets these ports by chance", {}};
  if (last < ephemeral.first || first > ephemeral.second) return finding;
  finding.health = Health::warn;
  finding.text = fmt::format("the kernel gives ports {} to {} to any program", ephemeral.first,
                             ephemeral.second);
  finding.advice = "a participant may find its port taken: take a --domain of other ports";
  return finding;
}

Findings check_shared_memory() {
  struct statvfs status {};
  if (statvfs("/dev/shm", &status) != 0 || access("/dev/shm", W_OK) != 0)
    return {{Health::warn, "shared memory", "/dev/shm is not there, or not to be written",
             "poses go over UDP, slower; mount a tmpfs at /dev/shm"}};
  Findings findings = {
      judge_shared_memory(status.f_frsize * status.f_blocks, status.f_frsize * status.f_bavail)};
  const SharedFiles files = shared_files();
  Finding stale{
      Health::ok,
      "shared files",
      fmt::format("{} of Fast DDS, {} left by dead processes", files.files, files.stale_segments),
      {}};
  if (files.stale_segments > 0) {
    stale.health = Health::warn;
    stale.advice = "poinsotd removes them when it starts";
  }
  findings.push_back(stale);
  return findings;
}

Finding judge_shared_memory(std::uint64_t size, std::uint64_t free) {
  Finding finding{Health::ok,
                  "shared memory",
                  fmt::format("/dev/shm {} MB, {} MB free", size / kMegabyte, free / kMegabyte),
                  {}};
  if (free < kSmallestSegment) {
    finding.health = Health::fail;
    finding.advice = "make room in /dev/shm, or mount a larger one";
  } else if (free < kLargestSegment) {
    finding.health = Health::warn;
    finding.advice =
        "enough for some thousand bodies; a scene of 100 000 wants 128 MB (docker: --shm-size)";
  }
  return finding;
}

Finding check_socket_buffers() {
  return judge_socket_buffers(number_in("/proc/sys/net/core/rmem_max"),
                              number_in("/proc/sys/net/core/wmem_max"));
}

Finding judge_socket_buffers(std::uint64_t receive, std::uint64_t send) {
  Finding finding{
      Health::ok,
      "socket buffers",
      fmt::format("at most {} kB to receive, {} kB to send", receive / 1024, send / 1024),
      {}};
  if (std::min(receive, send) >= kSocketBuffer) return finding;
  finding.health = Health::warn;
  finding.advice = fmt::format(
      "large frames over a network arrive late: sysctl -w net.core.rmem_max={0} "
      "net.core.wmem_max={0}",
      kSocketBuffer);
  return finding;
}

Finding check_profiles() {
  const char* const file = std::getenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  if (file == nullptr || *file == '\0')
    return {Health::ok, "profiles", "none (FASTRTPS_DEFAULT_PROFILES_FILE is not set)", {}};
  if (access(file, R_OK) != 0)
    return {Health::fail, "profiles", fmt::format("{} cannot be read", file),
            "set FASTRTPS_DEFAULT_PROFILES_FILE to a file, or unset it"};
  if (!takes_profiles(file))
    return {Health::fail, "profiles", fmt::format("{} is not understood", file),
            "poinsot doctor -v shows what Fast DDS says of it"};
  return {Health::ok, "profiles", fmt::format("{} is read", file), {}};
}

}  // namespace poinsot
