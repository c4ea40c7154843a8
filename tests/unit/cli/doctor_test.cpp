// The judgements of poinsot doctor.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "poinsot/cli/findings.h"
#include "poinsot/cli/host_checks.h"
#include "poinsot/wire/diagnosis.h"

namespace poinsot {
namespace {

constexpr std::uint64_t kMegabyte = 1 << 20;

TEST(Findings, AreALineEachWithAdviceBelow) {
  EXPECT_EQ(finding_text({Health::ok, "domain", "77", {}}), "ok    domain           77\n");
  EXPECT_EQ(finding_text({Health::fail, "ports", "taken", "wait"}),
            "fail  ports            taken\n                       → wait\n");
}

TEST(Findings, FailIfOneDoes) {
  EXPECT_FALSE(has_failed({{Health::ok, "", "", ""}, {Health::warn, "", "", ""}}));
  const Findings failed = {{Health::ok, "", "", ""}, {Health::fail, "a", "b", "c"}};
  EXPECT_TRUE(has_failed(failed));
  const auto json = nlohmann::json::parse(findings_json(failed));
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["findings"][1]["health"], "fail");
}

TEST(PortPlan, FollowsTheStandard) {
  const PortPlan plan = port_plan(77);
  EXPECT_EQ(plan.multicast, 7400 + 250 * 77);
  EXPECT_EQ(plan.unicast.front(), 7410 + 250 * 77);
  EXPECT_EQ(plan.unicast.at(1), 7411 + 250 * 77);
  EXPECT_LE(port_plan(232).unicast.back(), 65535);
}

TEST(PortRange, WarnsWhereTheKernelGivesPortsToAnyone) {
  EXPECT_EQ(parse_port_range("32768\t60999\n"), (std::pair{32768, 60999}));
  EXPECT_EQ(parse_port_range(""), std::nullopt);
  EXPECT_EQ(judge_port_range(26650, 26723, {32768, 60999}).health, Health::ok);
  EXPECT_EQ(judge_port_range(32700, 32773, {32768, 60999}).health, Health::warn);
  EXPECT_EQ(judge_port_range(65400, 65473, {32768, 60999}).health, Health::ok);
}

TEST(SharedMemory, FailsWithoutRoomForOneSegment) {
  EXPECT_EQ(judge_shared_memory(64 * kMegabyte, 0).health, Health::fail);
  EXPECT_EQ(judge_shared_memory(64 * kMegabyte, 60 * kMegabyte).health, Health::warn);
  EXPECT_EQ(judge_shared_memory(8192 * kMegabyte, 8000 * kMegabyte).health, Health::ok);
}

TEST(SocketBuffers, WarnBelowWhatTheBusAsksFor) {
  EXPECT_EQ(judge_socket_buffers(212992, 212992).health, Health::warn);
  EXPECT_EQ(judge_socket_buffers(4 * kMegabyte, 4 * kMegabyte).health, Health::ok);
}

}  // namespace
}  // namespace poinsot
