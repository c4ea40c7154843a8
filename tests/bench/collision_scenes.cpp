// What scenes cost in the collision layer: a bouncing ball, a cradle, bullets, a gas beside its
// flights, columns of boxes by one thread and two, and asleep. Prints a table, least of several
// runs where they are short.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <utility>

#include "poinsot/collision/collision_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Cost {
  double per_frame = 0;  // [s]
  CollisionReport last;
  std::uint64_t impacts = 0, restarts = 0, searches = 0;
  std::uint32_t crowded = 0, islands = 0;  // frames; in the largest frame
};

Cost run(CollisionLayer& layer, int frames) {
  Cost cost;
  const double start = now();
  const int first = static_cast<int>(std::lround(layer.time() * 60));
  for (int n = 1; n <= frames; ++n) {
    layer.advance_to((first + n) / 60.0);
    const CollisionReport& report = layer.report();
    cost.impacts += report.impacts;
    cost.restarts += report.restarts;
    cost.searches += report.searches;
    cost.crowded += report.crowded ? 1 : 0;
    cost.islands = std::max(cost.islands, report.islands);
  }
  cost.per_frame = (now() - start) / frames;
  cost.last = layer.report();
  return cost;
}

void print(const char* name, const Cost& cost, int frames) {
  std::printf("%-34s %10.2f %10.1f %8llu %8llu %9llu %8u %8u %8u\n", name, 1e6 * cost.per_frame,
              60e6 * cost.per_frame, static_cast<unsigned long long>(cost.impacts),
              static_cast<unsigned long long>(cost.restarts),
              static_cast<unsigned long long>(cost.searches / static_cast<unsigned>(frames)),
              cost.islands, cost.crowded, cost.last.asleep);
}

void best_of(int runs, const char* name, const Scene& scene, int frames) {
  Cost best;
  for (int k = 0; k < runs; ++k) {
    CollisionLayer layer(scene);
    const Cost cost = run(layer, frames);
    if (k == 0 || cost.per_frame < best.per_frame) best = cost;
  }
  print(name, best, frames);
}

Scene ball() {
  BodyDef body = test::body("ball", Sphere{0.1}, {0, 0, 10.1});
  body.material.restitution = 0.8;
  return test::scene({test::ground(), body});
}

Scene cradle() {
  std::vector<BodyDef> balls;
  for (int k = 0; k < 6; ++k) {
    balls.push_back(
        test::body("ball" + std::to_string(k), Sphere{0.1}, {k == 0 ? -1.0 : 0.2 * k, 0, 0}));
    balls.back().material = {0, 1};
  }
  balls[0].linear_velocity = {2, 0, 0};
  Scene scene = test::scene(balls);
  scene.simulation.gravity.setZero();
  return scene;
}

Scene gas(int bodies) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> side(-1, 1);
  const auto vector = [&] {
    const double x = side(random), y = side(random), z = side(random);
    return Vec3(x, y, z);
  };
  const int edge = static_cast<int>(std::ceil(std::cbrt(bodies)));
  std::vector<BodyDef> all;
  for (int k = 0; k < bodies; ++k) {
    all.push_back(test::body("body" + std::to_string(k), Box{{1, 0.5, 0.3}},
                             10 * Vec3(k % edge, k / edge % edge, k / edge / edge)));
    all.back().linear_velocity = 0.5 * vector();
    all.back().angular_velocity = 3 * vector();
  }
  Scene scene = test::scene(all);
  scene.simulation.gravity.setZero();
  return scene;
}

Scene columns(int edge, int threads, bool sleeping) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.02, 0.02);
  std::vector<BodyDef> all{test::ground()};
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y)
      for (int z = 0; z < edge; ++z) {
        const double dx = jitter(random), dy = jitter(random);
        all.push_back(test::body("box" + std::to_string(all.size()), Box{{1, 1, 1}},
                                 {1.5 * x + dx, 1.5 * y + dy, 0.6 + 1.1 * z}));
      }
  Scene scene = test::scene(all);
  scene.collision.threads = threads;
  scene.collision.sleeping = sleeping;
  return scene;
}

void free_bodies(int bodies, int frames) {
  const Scene scene = gas(bodies);
  double ratio = 1e9, layer_time = 0, flight_time = 0;
  for (int k = 0; k < 3; ++k) {
    CollisionLayer layer(scene);
    run(layer, 1);  // flights are set up
    const double with = run(layer, frames).per_frame;
    SimulationLayer flights(scene);
    flights.advance_to(1.0 / 60);
    const double start = now();
    for (int n = 2; n <= frames + 1; ++n) flights.advance_to(n / 60.0);
    const double alone = (now() - start) / frames;
    if (with / alone >= ratio) continue;
    ratio = with / alone;
    layer_time = with;
    flight_time = alone;
  }
  std::printf(
      "%d free bodies that never meet: %.3f ms a frame, their flights %.3f ms: %.2f times\n",
      bodies, 1e3 * layer_time, 1e3 * flight_time, ratio);
}

void all() {
  std::printf("%-34s %10s %10s %8s %8s %9s %8s %8s %8s\n", "scene", "us/frame", "us/s", "impacts",
              "restarts", "searches", "islands", "crowded", "asleep");
  best_of(50, "ball, 10 m, e = 0.8, 15 s", ball(), 900);
  best_of(50, "cradle of 5 + 1, 2 s", cradle(), 120);
  best_of(1, "27 boxes in columns, no sleep", columns(3, 1, false), 600);
  best_of(1, "27 boxes in columns", columns(3, 1, true), 600);
  best_of(1, "512 boxes in columns, 1 thread", columns(8, 1, false), 120);
  best_of(1, "512 boxes in columns, 2 threads", columns(8, 2, false), 120);
  CollisionLayer sleepers(columns(3, 1, true));
  run(sleepers, 1800);
  print("27 boxes asleep", run(sleepers, 600), 600);
  free_bodies(1000, 120);
  free_bodies(10000, 120);
}

}  // namespace
}  // namespace poinsot

int main() {
  poinsot::all();
}
