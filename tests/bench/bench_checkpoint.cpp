// What a checkpoint of the physics costs: its size, and the time to write it, to make a layer of
// the scene and to read it back; beside them the time to hash the state. Prints a table, the least
// of several times.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>

#include "poinsot/base/archive.h"
#include "poinsot/collision/collision_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

// [ms] The least of five.
double least_time(const std::function<void()>& task) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    task();
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    least = std::min(least, passed.count());
  }
  return least;
}

void measure(const char* name, const Scene& scene, int frames) {
  CollisionLayer layer(scene);
  for (int n = 1; n <= frames; ++n) layer.advance_to(n / 60.0);
  ByteWriter out;
  const double save = least_time([&] {
    out.clear();
    layer.save(out);
  });
  const double make = least_time([&] { CollisionLayer fresh(scene); });
  CollisionLayer fresh(scene);
  const double restore = least_time([&] {
    ByteReader in(out.bytes());
    fresh.restore(in);
  });
  const double hash = 1e3 * least_time([&] {
                        Hash64 all;
                        layer.hash_into(all);
                        volatile std::uint64_t value = all.value();
                        static_cast<void>(value);
                      });
  const auto bodies = static_cast<double>(scene.bodies.size());
  std::printf("%-32s %7.0f %9u %10zu %9.0f %9.2f %9.2f %9.2f %9.1f\n", name, bodies,
              layer.report().contacts, out.bytes().size(),
              static_cast<double>(out.bytes().size()) / bodies, save, make, restore, hash);
}

// Columns of ten boxes: 100 of them are 1000 bodies in contact.
Scene columns(Profile profile) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      for (int z = 0; z < 10; ++z)
        bodies.push_back(test::body("box" + std::to_string(bodies.size()), Box{{1, 1, 1}},
                                    {1.5 * x, 1.5 * y, 0.5 + z}));
  Scene scene = test::scene(std::move(bodies));
  scene.collision = collision_defaults(profile);
  return scene;
}

Scene awake(Scene scene) {
  scene.collision.sleeping = false;
  return scene;
}

Scene free_bodies(int n, bool with_shapes) {
  std::vector<BodyDef> bodies;
  for (int k = 0; k < n; ++k) {
    BodyDef def = test::body("body" + std::to_string(k), Box{{0.3, 0.4, 0.5}},
                             {3.0 * (k % 100), 3.0 * (k / 100), 0});
    if (!with_shapes) def.shapes.clear();
    def.angular_velocity = Vec3(1, 2 + 0.001 * k, 3);
    bodies.push_back(def);
  }
  return test::scene(std::move(bodies));
}

}  // namespace
}  // namespace poinsot

int main() {
  using namespace poinsot;
  std::printf("%-32s %7s %9s %10s %9s %9s %9s %9s %9s\n", "", "bodies", "points", "bytes",
              "per body", "save ms", "make ms", "restore", "hash us");
  measure("columns, accurate", awake(columns(Profile::accurate)), 30);
  measure("columns, fast", awake(columns(Profile::fast)), 30);
  measure("columns, asleep", columns(Profile::accurate), 30);
  measure("free boxes", free_bodies(10000, true), 30);
  measure("free bodies without shape", free_bodies(10000, false), 30);
}
