#include "poinsot/runner/replay.h"

#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/runner/checkpoint_file.h"
#include "poinsot/runner/run_offline.h"
#include "poinsot/scene/fragment.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

// What a frame loop does, without pace.
class RecordedRun {
 public:
  explicit RecordedRun(Scene scene) : layer_(std::move(scene)) {}

  PresentationLayer& layer() { return layer_; }

  void record(const std::filesystem::path& file) {
    log_.emplace(
        LogStart{.file = file, .world = "arena", .checkpoint = layer_.make_checkpoint("")});
  }
  bool stop_recording() { return log_->close(); }

  void tell(WrenchCommand wrench) {
    wrench.seq = ++seq_;
    wrenches_.push_back(std::move(wrench));
  }
  void tell(Order order) {
    order.control.seq = ++seq_;
    if (order.control.action == ControlAction::spawn && !order.fragment)
      order.fragment =
          std::make_shared<const std::vector<BodyDef>>(parse_fragment(order.control.text));
    orders_.push_back(std::move(order));
  }
  // A turn of the loop; the replies to what was told before it.
  const std::vector<Reply>& turn() {
    replies_.clear();
    if (wrenches_.empty() && orders_.empty()) return replies_;
    TurnRecord turn{layer_.frame() + 1, layer_.epoch(), {}, {}};
    std::swap(turn.wrenches, wrenches_);
    std::swap(turn.orders, orders_);
    const auto by_key = [](const auto& a, const auto& b) { return a.client < b.client; };
    std::ranges::stable_sort(turn.wrenches, by_key);  // seq grows already
    std::ranges::stable_sort(turn.orders, by_key, &Order::control);
    apply_turn(turn, layer_, replies_);
    if (log_) log_->turn(std::move(turn));
    return replies_;
  }
  void frames(int count = 1) {
    for (int n = 0; n < count; ++n) {
      turn();
      layer_.advance_frame();
      if (log_) log_->frame(layer_.frame(), layer_.snapshot().state_hash);
    }
  }

 private:
  PresentationLayer layer_;
  std::optional<CommandLogWriter> log_;
  std::uint64_t seq_ = 0;
  std::vector<WrenchCommand> wrenches_;
  std::vector<Order> orders_;
  std::vector<Reply> replies_;
};

Order order(ControlAction action, std::string name = {}) {
  Order result;
  result.control.client = 1;
  result.control.action = action;
  result.control.name = std::move(name);
  return result;
}

Order spawn(const std::string& text) {
  Order result = order(ControlAction::spawn);
  result.control.text = text;
  return result;
}

Order remove(const std::string& body) {
  Order result = order(ControlAction::remove);
  result.control.body_name = body;
  return result;
}

WrenchCommand push(const std::string& body, const Vec3& force, Hold hold = Hold::until_cleared) {
  return {.client = 1, .body_name = body, .force = force, .hold = hold};
}

Scene boxes() {
  Scene scene = test::scene({test::ground(0.5, 0.2)});
  for (int k = 0; k < 4; ++k)
    scene.bodies.push_back(test::box("box" + std::to_string(k), Vec3(1.5 * k, 0, 0.7 + 0.2 * k)));
  return scene;
}

ReplayResult replayed(const std::filesystem::path& file, const ReplayOptions& options = {}) {
  return replay(file, options, {});
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(Replay, AllFramesHaveTheRecordedHash) {
  const auto file = test::temp_path("pushed.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  run.tell(push("box1", Vec3(30, 1, 0)));
  run.frames(30);
  run.tell(push("nobody", Vec3(1, 0, 0)));  // is refused, then and now
  run.frames(60);
  ASSERT_TRUE(run.stop_recording());

  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 120u);
  EXPECT_EQ(result.commands, 2u);
  EXPECT_EQ(result.refused, 1u);
  EXPECT_EQ(result.sim_time, 2);
  EXPECT_EQ(to_text(result).rfind("all 120 frames have the recorded hash\n", 0), 0u);
}

TEST(Replay, NamesTheFirstFrameThatDiffers) {
  const auto file = test::temp_path("altered.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  run.tell(push("box1", Vec3(30, 1, 0)));
  run.frames(30);
  ASSERT_TRUE(run.stop_recording());
  std::string text = text_of(file);
  const std::size_t at = text.find("[30.0,1.0,0.0]");
  ASSERT_NE(at, std::string::npos);
  text.replace(at + 1, 4, "30.000000000000004");
  std::ofstream(file, std::ios::binary) << text;

  const ReplayResult result = replayed(file);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->recorded.frame, 31u);
  EXPECT_EQ(result.difference->found.frame, 31u);
  EXPECT_NE(result.difference->found.hash, result.difference->recorded.hash);
  EXPECT_EQ(result.difference->where, file.string() + ":33");
  EXPECT_EQ(result.frames, 31u);
  const std::string said = to_text(result);
  EXPECT_EQ(said.rfind("frame 31 differs (" + file.string() + ":33): recorded ", 0), 0u) << said;
  EXPECT_NE(said.find("the 30 frames before it are the same"), std::string::npos) << said;
}

TEST(Replay, BeginsInTheMiddleOfARun) {
  const auto file = test::temp_path("middle.log");
  RecordedRun run(boxes());
  run.tell(push("box0", Vec3(5, 0, 2)));
  run.frames(20);
  run.tell(spawn("bodies: [{name: ball, density: 10, shape: {sphere: 0.4}, position: [0, 3, 1]}]"));
  run.tell(order(ControlAction::save, "kept"));
  run.frames(20);
  run.tell(order(ControlAction::reset));
  run.frames(20);
  run.tell(spawn("bodies: [{name: ball, density: 10, shape: {sphere: 0.4}, position: [0, 4, 1]}]"));
  run.tell(push("ball", Vec3(1, 2, 3)));
  run.frames(10);
  run.record(file);
  WrenchCommand to_this_epoch = push("ball", Vec3(1, -2, 3));
  to_this_epoch.epoch = run.layer().epoch();
  run.tell(to_this_epoch);
  run.frames(10);
  run.tell(order(ControlAction::restore, "kept"));  // saved before the log began
  run.frames(10);
  run.tell(order(ControlAction::reset));  // to the scene without the ball
  run.frames(10);
  run.tell(push("ball", Vec3(1, 2, 3)));
  run.turn();
  run.frames(10);
  ASSERT_TRUE(run.stop_recording());

  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 40u);
  EXPECT_EQ(result.refused, 1u);
}

TEST(Replay, OfACutLogGoesAsFarAsItDoes) {
  const auto file = test::temp_path("cut_replay.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  ASSERT_TRUE(run.stop_recording());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 60);
  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.frames, 28u);
  EXPECT_TRUE(result.cut);
  EXPECT_NE(to_text(result).find("the log was cut: it has no end\n"), std::string::npos);
}

TEST(Replay, SaysItInJson) {
  ReplayResult result;
  result.frames = 7;
  result.difference = {{6, 1}, {6, 0xff}, "a.log:8"};
  EXPECT_EQ(to_json(result),
            R"({"frames":7,"commands":0,"refused":0,"same":false,"cut":false,"stopped":false,)"
            R"("sim_time":0.0,"wall_s":0.0,"first_difference":{"frame":6,)"
            R"("recorded":"0000000000000001","found":"00000000000000ff","where":"a.log:8"}})"
            "\n");
}

TEST(Replay, WritesTheTrajectoryOfBodiesThatComeAndGo) {
  const auto file = test::temp_path("come_and_go.log"), table = test::temp_path("come_and_go.csv");
  RecordedRun run(boxes());
  run.record(file);
  run.tell(remove("box3"));
  run.frames(1);
  run.tell(spawn("bodies: [{name: 'a, b', static: true}, {name: c, static: true}]"));
  run.frames(1);
  ASSERT_TRUE(run.stop_recording());
  ASSERT_FALSE(replayed(file, {.threads = 0, .trajectory = table}).difference);
  std::ifstream in(table);
  std::map<std::string, std::string> bodies;  // of each frame
  for (std::string line; std::getline(in, line);) {
    const std::size_t name = line.find(',', line.find(',') + 1) + 1;
    const std::size_t end = line.find(line[name] == '"' ? "\"," : ",", name);
    bodies[line.substr(0, line.find(','))] += line.substr(name, end - name) + " ";
  }
  EXPECT_EQ(bodies["0"], "ground box0 box1 box2 box3 ");
  EXPECT_EQ(bodies["1"], "ground box0 box1 box2 ");
  EXPECT_EQ(bodies["2"], "ground box0 box1 box2 \"a, b c ");
}

// A long session ------------------------------------------------------------------------------

class RandomSession {
 public:
  RandomSession(RecordedRun& run, unsigned seed) : run_(run), random_(seed) {}

  void frames(int count) {
    for (int n = 0; n < count; ++n) {
      for (int turns = 0; turns < 2; ++turns) {
        while (chance(0.3)) something();
        run_.turn();
      }
      run_.frames();
    }
  }

 private:
  double number(double most) { return std::uniform_real_distribution(-most, most)(random_); }
  bool chance(double p) { return std::bernoulli_distribution(p)(random_); }
  int below(int end) { return std::uniform_int_distribution(0, end - 1)(random_); }
  Vec3 vector(double most) { return {number(most), number(most), number(most)}; }

  std::string some_body() {
    const auto& names = run_.layer().world().names;
    return chance(0.05) ? "nobody" : names[static_cast<std::size_t>(below(int(names.size())))];
  }

  void something() {
    const int what = below(100);
    if (what < 70) return run_.tell(some_wrench());
    if (what < 80) return set_state();
    if (what < 86) return some_spawn();
    if (what < 89) return run_.tell(remove(some_body()));
    if (what < 92) return run_.tell(order(ControlAction::save, "s" + std::to_string(below(5))));
    if (what < 95) return run_.tell(order(ControlAction::release));
    if (what < 98) return run_.tell(order(ControlAction::restore, "s" + std::to_string(below(5))));
    Order reset = order(ControlAction::reset);
    reset.control.scope = static_cast<std::uint8_t>(below(kMaxResetScope + 1));
    run_.tell(reset);
  }

  WrenchCommand some_wrench() {
    WrenchCommand w;
    w.client = static_cast<std::uint64_t>(1 + below(3));
    w.slot = static_cast<std::uint32_t>(below(4));
    if (chance(0.9)) w.body_name = some_body();
    w.kind = static_cast<WrenchKind>(below(3));
    w.hold = static_cast<Hold>(below(4));
    if (w.kind == WrenchKind::impulse && w.hold != Hold::clear) w.hold = Hold::frame;
    if (w.kind == WrenchKind::tether) {
      w.target = vector(3);
      w.stiffness = 10 + number(10);
      w.damping = 1 + number(1);
    } else {
      w.force = vector(20);
      if (chance(0.5)) w.torque = vector(5);
      w.axes = static_cast<Axes>(below(2));
    }
    w.point_frame = static_cast<PointFrame>(below(3));
    w.point = vector(0.5);
    if (w.hold == Hold::duration) w.duration_ns = 1 + below(500'000'000);
    if (chance(0.2)) w.start_frame = run_.layer().frame() + static_cast<std::uint64_t>(below(9));
    if (chance(0.1)) w.epoch = run_.layer().epoch();
    w.outlives_client = chance(0.3);
    return w;
  }

  void set_state() {
    Order set = order(ControlAction::set_state);
    RunControl& c = set.control;
    c.body_name = some_body();
    c.sets_position = chance(0.5);
    c.sets_orientation = chance(0.5);
    c.sets_linear = chance(0.5);
    c.sets_angular = chance(0.5);
    c.position = vector(4) + Vec3(0, 0, 5);
    c.orientation = Quat(1 + number(0.5), number(1), number(1), number(1)).normalized();
    c.linear_velocity = vector(3);
    c.angular_velocity = vector(3);
    run_.tell(set);
  }

  void some_spawn() {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "bodies: [{name: new%d, density: %.17g, shape: {%s}, position: [%.17g, %.17g, 9]}]",
        spawned_++, 300 + number(200), chance(0.5) ? "sphere: 0.4" : "box: [0.5, 0.6, 0.7]",
        number(4), number(4));
    run_.tell(spawn(text));
  }

  RecordedRun& run_;
  std::mt19937 random_;
  int spawned_ = 0;
};

TEST(Replay, ALongSessionOfEverythingHasEveryHash) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto file = test::temp_path("session" + std::to_string(seed) + ".log");
    RecordedRun run(boxes());
    RandomSession session(run, seed);
    session.frames(40);
    run.record(file);
    session.frames(360);
    ASSERT_TRUE(run.stop_recording());
    for (const int threads : {0, 2}) {
      const ReplayResult result = replayed(file, {.threads = threads, .trajectory = {}});
      EXPECT_FALSE(result.difference) << "seed " << seed << ": " << to_text(result);
      EXPECT_EQ(result.frames, 360u);
      EXPECT_GT(result.commands, 100u);
      EXPECT_GT(result.refused, 0u);
      EXPECT_LT(result.refused, result.commands / 2);
    }
  }
}

// Offline ----------------------------------------------------------------------------------------

TEST(RunOffline, RecordsALogThatReplays) {
  const auto file = test::temp_path("offline.log");
  const RunSummary summary = run_offline(boxes(), {.frames = 90, .record = file}, {});
  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 90u);
  EXPECT_EQ(summary.frames, 90u);
}

TEST(RunOffline, DoesWhatALogSaysAndRecordsItAgain) {
  const auto file = test::temp_path("told.log"), again = test::temp_path("again.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(10);
  run.tell(push("box2", Vec3(10, 0, 40)));
  run.frames(50);
  ASSERT_TRUE(run.stop_recording());

  const RunSummary summary = run_offline(boxes(), {.commands = file, .record = again}, {});
  EXPECT_EQ(summary.frames, 60u);
  EXPECT_EQ(summary.state_hash, run.layer().snapshot().state_hash);
  EXPECT_FALSE(replayed(again).difference);
  EXPECT_EQ(replayed(again).commands, 1u);
  // Frames beyond the log, and fewer than it has.
  EXPECT_EQ(run_offline(boxes(), {.frames = 100, .commands = file}, {}).frames, 100u);
  EXPECT_EQ(run_offline(boxes(), {.frames = 5, .commands = file}, {}).frames, 5u);
}

TEST(RunOffline, RefusesALogThatBeginsLater) {
  const auto file = test::temp_path("later.log");
  RecordedRun run(boxes());
  run.frames(3);
  run.record(file);
  run.frames(3);
  ASSERT_TRUE(run.stop_recording());
  EXPECT_THROW(run_offline(boxes(), {.commands = file}, {}), Error);
}

TEST(RunOffline, RefusesALogThatCannotBeCreated) {
  EXPECT_THROW(run_offline(boxes(), {.frames = 1, .record = "/proc/none/x.log"}, {}), Error);
}

}  // namespace
}  // namespace poinsot
