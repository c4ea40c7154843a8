// What changes of the world between frames cost: of a body in the middle of a scene of many, the
// time of the change itself and how much longer the frame after it takes. Prints a table of
// medians.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/collision/collision_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

// [us]
double time_of(const std::function<void()>& task) {
  const auto start = std::chrono::steady_clock::now();
  task();
  const std::chrono::duration<double, std::micro> passed = std::chrono::steady_clock::now() - start;
  return passed.count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

// Columns of ten boxes on a half-space.
Scene columns(int side) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < 10; ++z)
        bodies.push_back(test::body("box" + std::to_string(bodies.size()), Box{{1, 1, 1}},
                                    {1.5 * x, 1.5 * y, 0.5 + z}));
  return test::scene(std::move(bodies));
}

struct Costs {
  std::vector<double> change, frame;  // [us]
};

void print(const char* name, const Costs& costs, double quiet) {
  std::printf("  %-12s %10.1f %12.1f\n", name, median(costs.change), median(costs.frame) - quiet);
}

void measure(int side) {
  CollisionLayer layer(columns(side));
  const auto frame = [&] { layer.advance_to(layer.time() + 1.0 / 60); };
  for (int n = 0; n < 120; ++n) frame();
  Costs spawn, remove, set_state, kick;
  std::vector<double> quiet;
  const auto note = [&](Costs& costs, const std::function<void()>& change) {
    costs.change.push_back(time_of(change));
    costs.frame.push_back(time_of(frame));
    quiet.push_back(time_of(frame));
  };
  BodyDef body = test::body("new", Sphere{0.3}, {-50, 0, 1000});
  Eigen::Index i = 0;
  for (int n = 0; n < 101; ++n) {
    note(spawn, [&] { i = layer.spawn(body); });
    note(set_state, [&] { layer.set_state(i, {{-60, 0, 1000}, Quat::Identity()}, {}); });
    note(kick, [&] { layer.kick(i, {{1, 0, 0}, Vec3::Zero()}); });
    note(remove, [&] { layer.remove(i); });
    ++body.generation;
  }
  std::printf("%zu bodies, %u asleep; a frame without a change: %.1f us\n",
              std::as_const(layer).world().ids.size(), layer.report().asleep, median(quiet));
  std::printf("  %-12s %10s %12s\n", "", "change, us", "frame, + us");
  print("spawn", spawn, median(quiet));
  print("set_state", set_state, median(quiet));
  print("kick", kick, median(quiet));
  print("remove", remove, median(quiet));
}

}  // namespace
}  // namespace poinsot

int main() {
  for (const int side : {3, 10, 30}) poinsot::measure(side);
}
