// A long session of everything that a log can hold, at random.

#include <cstdio>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "support/recorded_run.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

using test::boxes;
using test::order;
using test::RecordedRun;
using test::remove;
using test::replayed;
using test::spawn;

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

}  // namespace
}  // namespace poinsot
