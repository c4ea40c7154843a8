// A client of another vendor, both directions: Cyclone DDS in C against the daemon, each a process.
// What it received and sent is the test's output.

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

// All falls, but for the crate on the table. The probe is pushed; the cue hits the ball after half
// a second, elastically.
constexpr const char* kScene = R"(world: other_vendor
bodies:
  - {name: probe, shape: {sphere: 0.1}, mass: 2}
  - {name: cue, shape: {sphere: 0.1}, mass: 1, position: [5, 0, 0], linear_velocity: [1, 0, 0], material: {restitution: 1}}
  - {name: ball, shape: {sphere: 0.1}, mass: 1, position: [5.695, 0, 0], material: {restitution: 1}}
  - {name: table, static: true, shape: {box: [1, 1, 1]}, position: [0, 50, 0]}
  - {name: crate, shape: {box: [0.4, 0.4, 0.4]}, mass: 12.5, position: [0, 50, 0.7]}
)";
constexpr double kGravity[] = {0, 0, -9.81};  // [m/s2]
constexpr double kCrate = 12.5;               // [kg]
constexpr double kMass = 2;                   // [kg] of the probe
constexpr double kForce[] = {3, -2, 5};       // [N]
constexpr double kFrameRate = 60;             // [Hz]
constexpr std::uint64_t kPushFrames = 30;     // half a second
constexpr std::uint64_t kFollowed = 60;       // frames
constexpr double kPushTolerance = 1e-12;      // relative: what is promised of Δv

// Lines of the peer's output, by their first word; the rest are numbers and words.
using Fields = std::vector<std::string>;
using Lines = std::map<std::string, std::vector<Fields>>;

Lines split(const std::string& output) {
  Lines lines;
  std::istringstream text(output);
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    Fields fields;
    for (std::string word; words >> word;) fields.push_back(word);
    if (fields.empty()) continue;
    const std::string kind = fields.front();
    fields.erase(fields.begin());
    lines[kind].push_back(fields);
  }
  return lines;
}

double number(const Fields& fields, std::size_t i) {
  return std::stod(fields.at(i));
}
std::uint64_t integer(const Fields& fields, std::size_t i) {
  return std::stoull(fields.at(i));
}

void expect_scene(const Lines& lines) {
  const std::vector<Fields>& bodies = lines.at("body");
  ASSERT_EQ(bodies.size(), 5u);
  std::map<std::string, double> masses;
  for (const Fields& body : bodies) masses[body.at(5)] = number(body, 4);
  EXPECT_EQ(masses,
            (std::map<std::string, double>{
                {"probe", kMass}, {"cue", 1}, {"ball", 1}, {"table", 0}, {"crate", kCrate}}));
}

// Momentum of the probe in every frame: F t, to the last frame of effect, and m g t.
void expect_push(const Lines& lines) {
  const Fields& reply = lines.at("reply").at(0);
  EXPECT_EQ(reply.at(2), "1");  // OK
  const std::uint64_t first = integer(reply, 3), last = integer(reply, 4);
  EXPECT_EQ(first, 1u);  // it was paused before its first frame
  EXPECT_EQ(last, kPushFrames);
  std::uint64_t expected_frame = 0;  // paused, and shown to newcomers
  for (const Fields& pose : lines.at("pose")) {
    const std::uint64_t frame = integer(pose, 0);
    ASSERT_EQ(frame, expected_frame++);
    EXPECT_EQ(pose.at(2), "4");  // bodies that move
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double pushed = kForce[axis] * static_cast<double>(std::min(frame, last)) / kFrameRate;
      const double fallen = kMass * kGravity[axis] * static_cast<double>(frame) / kFrameRate;
      EXPECT_NEAR(kMass * number(pose, 3 + axis), pushed + fallen,
                  kPushTolerance * (std::abs(pushed) + std::abs(fallen)))
          << frame;
    }
  }
  EXPECT_GT(expected_frame, kFollowed);
}

void expect_impact(const Lines& lines) {
  ASSERT_EQ(lines.count("event"), 1u);
  const std::vector<Fields>& events = lines.at("event");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].at(0), "30");
  EXPECT_NEAR(number(events[0], 1), 0.495, 1e-9);
  EXPECT_NEAR(std::abs(number(events[0], 2)), 1, 1e-8);  // [N s]: the speed goes over
}

// The table carries the crate's weight, in every frame that tells.
void expect_contacts(const Lines& lines) {
  ASSERT_EQ(lines.count("contacts"), 1u);
  int carried = 0;
  for (const Fields& contacts : lines.at("contacts")) {
    if (contacts.at(1) == "0") continue;
    ++carried;
    EXPECT_NEAR(number(contacts, 2), 0, 1e-9);
    EXPECT_NEAR(number(contacts, 4), -kCrate * kGravity[2], 1e-6);
  }
  EXPECT_GT(carried, 0);
}

// The push is held, and then it is not.
void expect_held(const Lines& lines) {
  ASSERT_EQ(lines.count("held"), 1u);
  std::set<std::string> items;
  for (const Fields& held : lines.at("held")) items.insert(held.at(1));
  EXPECT_EQ(items.count("1"), 1u);
  EXPECT_EQ(lines.at("held").back().at(1), "0");
}

TEST(Cyclone, PeerReadsSceneAndFramesPushesAndControls) {
  // lo cannot multicast by default: the peer is told where to look.
  setenv("CYCLONEDDS_URI",
         "<General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces></General><Discovery>"
         "<ParticipantIndex>auto</ParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers>"
         "</Discovery>",
         1);
  const TemporaryFile scene("other_vendor.yaml", kScene);
  const Daemon daemon(scene.path(), {"--paused"});
  ChildProcess peer(POINSOT_CYCLONE_PEER, {std::to_string(test_domain()), "other_vendor", "probe",
                                           "3", "-2", "5", "0.5", std::to_string(kFollowed)});
  const std::string output = peer.read_rest();
  const int code = peer.wait();
  std::printf("%s", output.c_str());
  ASSERT_EQ(code, 0) << peer.errors();
  const Lines lines = split(output);
  expect_scene(lines);
  expect_push(lines);
  expect_impact(lines);
  expect_contacts(lines);
  expect_held(lines);
  EXPECT_EQ(lines.at("sent").size(), 3u);
  ASSERT_EQ(lines.at("reply").size(), 3u);
  for (const Fields& reply : lines.at("reply")) EXPECT_EQ(reply.at(2), "1");
  EXPECT_EQ(lines.at("summary").at(0).at(3), "0");  // gaps

  // The frame that it paused at, from three sources.
  const Fields& paused = lines.at("reply")[2];
  EXPECT_EQ(lines.at("pose").back().at(0), paused.at(4));
  EXPECT_EQ(lines.at("pose").back().at(1), paused.at(5));  // the hash
  const Json status = client_json({"status"});
  EXPECT_EQ(status["state"], "paused");
  EXPECT_EQ(status["frame"].get<std::uint64_t>(), integer(paused, 4));
}

}  // namespace
}  // namespace poinsot
