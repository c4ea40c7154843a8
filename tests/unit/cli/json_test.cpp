#include "poinsot/cli/json.h"

#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "unit/cli/sample.h"

namespace poinsot {
namespace {

using nlohmann::json;

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

// One line of JSON.
json parsed(const std::string& text) {
  EXPECT_EQ(text.find('\n'), text.size() - 1) << text;
  return json::parse(text);
}

json poses_of(const PoseSnapshot& poses, const std::vector<std::string>& wanted = {}) {
  return parsed(pose_json(poses, Roster(sample::bodies(), wanted), 60));
}

TEST(PoseJson, HasExactlyTheDocumentedKeys) {
  const json frame = poses_of(sample::poses());
  EXPECT_EQ(keys(frame), (std::set<std::string>{"frame", "time", "bodies"}));
  ASSERT_EQ(frame["bodies"].size(), 2u);
  for (const json& body : frame["bodies"]) {
    EXPECT_EQ(keys(body), (std::set<std::string>{"name", "position", "orientation",
                                                 "linear_velocity", "angular_velocity"}));
    EXPECT_EQ(keys(body["orientation"]), (std::set<std::string>{"x", "y", "z", "w"}));
    for (const char* vector : {"position", "linear_velocity", "angular_velocity"})
      EXPECT_EQ(body[vector].size(), 3u) << vector;
  }
}

TEST(PoseJson, KeepsEveryBit) {
  const json frame = poses_of(sample::poses());
  EXPECT_EQ(frame["frame"], 12);
  EXPECT_EQ(frame["time"].get<double>(), 0.2);
  const json& box = frame["bodies"][0];
  EXPECT_EQ(box["name"], "box");
  EXPECT_EQ(box["position"][0].get<double>(), 0.1);
  EXPECT_EQ(box["position"][2].get<double>(), 1e-17);
  EXPECT_EQ(box["angular_velocity"][2].get<double>(), 1.0 / 3);
  EXPECT_EQ(box["orientation"]["w"].get<double>(), 0.5);
  EXPECT_EQ(box["orientation"]["x"].get<double>(), 0.5);
  EXPECT_EQ(box["orientation"]["y"].get<double>(), -0.5);
}

TEST(PoseJson, WritesWholeNumbersAsFloatingPoint) {
  const json frame = poses_of(sample::poses());
  EXPECT_TRUE(frame["bodies"][0]["position"][1].is_number_float());
  EXPECT_EQ(frame["bodies"][0]["position"][1].get<double>(), -2.0);
  EXPECT_TRUE(frame["bodies"][1]["position"][0].is_number_float());
}

TEST(PoseJson, StaysJsonWhenANumberIsNotFinite) {
  PoseSnapshot poses = sample::poses();
  poses.bodies[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(poses_of(poses)["bodies"][0]["position"][0].is_null());
}

TEST(PoseJson, EscapesNames) {
  std::vector<BodyInfo> bodies = sample::bodies();
  bodies[1].name = "a \"quoted\" näme\n";
  const json frame = parsed(pose_json(sample::poses(), Roster(bodies, {}), 60));
  EXPECT_EQ(frame["bodies"][0]["name"], bodies[1].name);
}

TEST(PoseJson, HoldsTheWantedBodiesOnly) {
  const json frame = poses_of(sample::poses(), {"big ball"});
  ASSERT_EQ(frame["bodies"].size(), 1u);
  EXPECT_EQ(frame["bodies"][0]["name"], "big ball");
}

TEST(PoseJson, SaysWhenOnlySomeBodiesWereSent) {
  PoseSnapshot poses = sample::poses();
  poses.complete = false;
  EXPECT_EQ(poses_of(poses)["complete"], false);
}

TEST(ImpactJson, HasNoNegativeZeros) {
  ImpactNotice impact = sample::impact();
  impact.point = {-0.0, 1, -0.0};
  EXPECT_EQ(parsed(impact_json(impact, "a", "b"))["point"].dump(), "[0.0,1.0,0.0]");
}

TEST(ContactsJson, HoldsTheContactsOfAFrame) {
  ContactSnapshot contacts;
  contacts.frame = 30;
  contacts.epoch = 2;
  contacts.left_out = 1;
  contacts.contacts = {{sample::kBox, sample::kTable, {1, 2, 3}, {0, 0, 1}, {0, 0, 9.81}},
                       {sample::kBall, sample::kTable, {4, 5, 6}, {0, 0, 1}, {0, 0, 2}}};
  const json frame = parsed(contacts_json(contacts, Roster(sample::bodies(), {"box"}), 60));
  EXPECT_EQ(keys(frame), (std::set<std::string>{"frame", "epoch", "time", "left_out", "contacts"}));
  EXPECT_EQ(frame["time"], 0.5);
  ASSERT_EQ(frame["contacts"].size(), 1u);
  EXPECT_EQ(frame["contacts"][0]["a"], "box");
  EXPECT_EQ(frame["contacts"][0]["force"], json({0.0, 0.0, 9.81}));
}

WrenchCommand push_of_the_box() {
  WrenchCommand command;
  command.body_name = "box";
  return command;
}

TEST(PushJson, NamesFramesAndTheTimesOfTheirBoundaries) {
  Reply reply;
  reply.epoch = 3;
  reply.first_frame = 121;
  reply.last_frame = 150;
  const json answer = parsed(push_json(push_of_the_box(), reply, 60));
  EXPECT_EQ(answer["body"], "box");
  EXPECT_EQ(answer["code"], "OK");
  EXPECT_EQ(answer["epoch"], 3);
  EXPECT_EQ(answer["first_frame"], 121);
  EXPECT_EQ(answer["last_frame"], 150);
  EXPECT_EQ(answer["start_time"].get<double>(), 2.0);
  EXPECT_EQ(answer["end_time"].get<double>(), 2.5);
}

TEST(PushJson, HasNoEndUntilCleared) {
  Reply reply;
  reply.first_frame = 1;
  reply.last_frame = kForever;
  const json answer = parsed(push_json(push_of_the_box(), reply, 60));
  EXPECT_TRUE(answer["last_frame"].is_null());
  EXPECT_TRUE(answer["end_time"].is_null());
}

TEST(PushJson, CarriesTheReasonOfARefusalAndNoFrames) {
  Reply reply;
  reply.code = ResultCode::not_found;
  reply.message = "no body 'bax'";
  const json answer = parsed(push_json(push_of_the_box(), reply, 60));
  EXPECT_EQ(answer["code"], "NOT_FOUND");
  EXPECT_EQ(answer["message"], "no body 'bax'");
  EXPECT_FALSE(answer.contains("first_frame"));
}

TEST(ControlJson, NamesTheFrameReachedAndItsHash) {
  Reply reply;
  reply.epoch = 1;
  reply.last_frame = 30;
  reply.state_hash = 0xFEDCBA9876543210;
  const json answer = parsed(control_json("step", reply, 60));
  EXPECT_EQ(answer["action"], "step");
  EXPECT_EQ(answer["frame"], 30);
  EXPECT_EQ(answer["time"].get<double>(), 0.5);
  EXPECT_EQ(answer["state_hash"], "fedcba9876543210");
}

TEST(ImpactJson, CarriesEverythingWithAllItsDigits) {
  const json impact = parsed(impact_json(sample::impact(), "big ball", "table"));
  EXPECT_EQ(keys(impact), (std::set<std::string>{"frame", "epoch", "time", "a", "b", "point",
                                                 "normal", "impulse"}));
  EXPECT_EQ(impact["frame"], 28);
  EXPECT_EQ(impact["epoch"], 2);
  EXPECT_EQ(impact["time"].get<double>(), 0.1 + 0.35);
  EXPECT_EQ(impact["a"]["name"], "big ball");
  EXPECT_EQ(impact["b"]["name"], "table");
  EXPECT_EQ(impact["a"]["linear_before"], json({1.0, 0.0, -4.0}));
  EXPECT_EQ(impact["a"]["linear_after"], json({1.0, 0.0, 2.0}));
  EXPECT_EQ(impact["a"]["angular_after"], json({0.0, 0.25, 0.0}));
  EXPECT_EQ(impact["point"][2].get<double>(), 1.0 / 3);
  EXPECT_EQ(impact["normal"], json({0.0, 0.0, 1.0}));
  EXPECT_EQ(impact["impulse"], json({0.0, 0.0, 1.5}));
}

TEST(StatusJson, CountsIslandsSearchesImpactsAndSleepers) {
  RunReport report;
  report.frame.islands = 2;
  report.frame.restarts = 3;
  report.frame.impact_searches = 4;
  report.frame.impacts = 5;
  report.frame.impacts_so_far = 6;
  report.frame.asleep = 7;
  report.frame.soft_bodies = 9;
  report.frame.direct_bodies = 10;
  report.frame.solver_iterations = 11;
  report.frame.unconverged = 12;
  report.frame.contact_residual = 1e-4 / 3;
  report.frame.flags = FrameFlag::crowded;
  report.events_dropped = 8;
  const json status = parsed(status_json("push_me", report, {}));
  EXPECT_EQ(status["islands"], 2);
  EXPECT_EQ(status["restarts"], 3);
  EXPECT_EQ(status["impact_searches"], 4);
  EXPECT_EQ(status["impacts"], 5);
  EXPECT_EQ(status["impacts_so_far"], 6);
  EXPECT_EQ(status["asleep"], 7);
  EXPECT_EQ(status["soft_bodies"], 9);
  EXPECT_EQ(status["direct_bodies"], 10);
  EXPECT_EQ(status["solver_iterations"], 11);
  EXPECT_EQ(status["unconverged"], 12);
  EXPECT_EQ(status["contact_residual"].get<double>(), 1e-4 / 3);
  EXPECT_EQ(status["events_dropped"], 8);
  EXPECT_EQ(status["flags"], json({"crowded"}));
}

TEST(StatusJson, NamesStateAndFlags) {
  RunReport report;
  report.state = RunState::paused;
  report.frame.flags = FrameFlag::overrun | FrameFlag::inbox_full;
  report.times.collision.cpu_s = 1.5;
  const json status = parsed(status_json("push_me", report, {}));
  EXPECT_EQ(status["world"], "push_me");
  EXPECT_EQ(status["state"], "paused");
  EXPECT_EQ(status["flags"], json({"inbox_full", "overrun"}));
  EXPECT_EQ(status["cpu_s"]["collision"], 1.5);
}

RunReport report_of_two() {
  RunReport report;
  report.session = 7;
  report.frame.methods[static_cast<std::size_t>(Method::flight)] = 1;
  report.frame.methods[static_cast<std::size_t>(Method::taylor)] = 1;
  report.body_methods = {Method::taylor, Method::flight};
  return report;
}

TEST(StatusJson, CarriesTheErrorsWithAllTheirDigits) {
  RunReport report;
  report.frame.position_error = 1e-13 / 3;
  report.frame.orientation_error = 2e-13 / 3;
  report.frame.momentum_error = 4e-13 / 3;
  report.frame.flags = FrameFlag::stiff;
  const json status = parsed(status_json("push_me", report, {}));
  EXPECT_EQ(status["position_error"].get<double>(), 1e-13 / 3);
  EXPECT_EQ(status["orientation_error"].get<double>(), 2e-13 / 3);
  EXPECT_EQ(status["momentum_error"].get<double>(), 4e-13 / 3);
  EXPECT_EQ(status["flags"], json({"stiff"}));
}

TEST(StatusJson, CountsEveryMethodAndNamesTheBodies) {
  const json status = parsed(status_json("push_me", report_of_two(), sample::bodies()));
  EXPECT_EQ(status["methods"].size(), kMethodNames.size());
  EXPECT_EQ(status["methods"]["flight"], 1);
  EXPECT_EQ(status["methods"]["rk4"], 0);
  // The table is static.
  EXPECT_EQ(status["body_methods"], json::parse(R"([{"name": "box", "method": "taylor"},
                                                    {"name": "big ball", "method": "flight"}])"));
}

TEST(StatusJson, NumbersTheBodiesWhenTheirNamesAreNotKnown) {
  const json expected = json::parse(R"([{"index": 0, "method": "taylor"},
                                        {"index": 1, "method": "flight"}])");
  RunReport report = report_of_two();
  EXPECT_EQ(parsed(status_json("push_me", report, {}))["body_methods"], expected);
  report.session = 8;  // the names are those of the daemon before
  EXPECT_EQ(parsed(status_json("push_me", report, sample::bodies()))["body_methods"], expected);
}

TEST(ListJson, GivesNoMassToAStaticBody) {
  const json list = parsed(list_json("push_me", {}, sample::bodies()));
  EXPECT_EQ(list["bodies"].size(), 3u);
  EXPECT_EQ(list["bodies"][0]["static"], true);
  EXPECT_TRUE(list["bodies"][0]["mass"].is_null());
  EXPECT_EQ(list["bodies"][1]["mass"], 2.0);
}

}  // namespace
}  // namespace poinsot
