// What the presentation layer costs beside the physics: taking commands, frames in which many push,
// many held wrenches that nobody touches, checkpoints, spawning. Prints; takes some seconds.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;

// The median of some goes [ms].
template <class Work>
double median_ms(int goes, Work&& work) {
  std::vector<double> times;
  for (int n = 0; n < goes; ++n) {
    const auto start = Clock::now();
    work(n);
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + goes / 2, times.end());
  return times[static_cast<std::size_t>(goes / 2)];
}

void print(const char* what, double ms) {
  std::printf("%-66s %9.3f ms\n", what, ms);
}

std::string name(std::uint64_t n) {
  return "body-" + std::to_string(n);
}

// Bodies far from each other that fly.
Scene flying(int count) {
  Scene scene = test::empty_scene();
  for (int n = 0; n < count; ++n)
    scene.bodies.push_back(test::box(name(static_cast<std::uint64_t>(n)),
                                     Vec3(4 * (n % 100), 4 * (n / 100 % 100), 4 * (n / 10000))));
  return scene;
}

void measure_commands() {
  PresentationLayer layer(flying(10'000));
  std::vector<Reply> replies;
  std::vector<WrenchCommand> commands(1024);
  std::uint64_t seq = 0;
  const auto fill = [&](auto&& change) {
    for (std::uint64_t k = 0; k < commands.size(); ++k) {
      commands[k] = test::push(1, ++seq, name(k));
      change(commands[k], k);
    }
  };
  const auto accept = [&](const char* what, auto&& change) {
    print(what, median_ms(9, [&](int) {
            fill(change);
            replies.clear();
            layer.accept(commands, replies);
          }));
    layer.advance_frame();
  };
  print("a frame of 10000 flying bodies", median_ms(50, [&](int) { layer.advance_frame(); }));
  accept("1024 commands by name, of one client", [](auto&, auto) {});
  accept("1024 into as many slots again and again", [](WrenchCommand& c, std::uint64_t k) {
    c.hold = Hold::until_cleared;
    c.slot = static_cast<std::uint32_t>(k + 1);
  });
  accept("1024 of 1024 clients", [](WrenchCommand& c, std::uint64_t k) { c.client = k + 1; });
  accept("1024 misspelt names", [](WrenchCommand& c, std::uint64_t) { c.body_name += "x"; });
  accept("1024 clears ahead of their time", [&](WrenchCommand& c, std::uint64_t) {
    c.hold = Hold::clear;
    c.body_name.clear();
    c.start_frame = layer.frame() + 100;
  });
}

void measure_held() {
  PresentationLayer layer(flying(10'000));
  std::vector<Reply> replies;
  const auto push_all = [&](std::uint64_t clients, std::uint64_t each, Hold hold) {
    std::vector<WrenchCommand> commands;
    for (std::uint64_t client = 1; client <= clients; ++client)
      for (std::uint64_t k = 1; k <= each; ++k) {
        commands.push_back(test::push(client, layer.frame() * each + k, name(k % 10'000)));
        commands.back().hold = hold;
      }
    replies.clear();
    layer.accept(commands, replies);
  };
  print("a frame in which 1000 clients push one frame each", median_ms(50, [&](int) {
          push_all(1000, 1, Hold::frame);
          layer.advance_frame();
        }));
  push_all(16, 4096, Hold::until_cleared);
  layer.advance_frame();
  print("a frame with 65536 held forces that nobody touches",
        median_ms(20, [&](int) { layer.advance_frame(); }));
  HeldList list;
  print("a list of what is held", median_ms(20, [&](int) { layer.held(list); }));
}

void measure_changes() {
  PresentationLayer layer(flying(10'000));
  layer.advance_frame();
  print("a checkpoint of 10000 bodies",
        median_ms(9, [&](int) { layer.obey(test::order(ControlAction::save, "x")); }));
  print("its restoring",
        median_ms(9, [&](int) { layer.obey(test::order(ControlAction::restore, "x")); }));
  print("a body that comes in", median_ms(9, [&](int n) {
          test::spawn(layer, {test::box("new" + std::to_string(n), Vec3(4 * n, 0, -50))});
        }));
  print("a body that goes",
        median_ms(9, [&](int n) { test::remove(layer, "new" + std::to_string(n)); }));
}

}  // namespace
}  // namespace poinsot

int main() {
  poinsot::measure_commands();
  poinsot::measure_held();
  poinsot::measure_changes();
}
