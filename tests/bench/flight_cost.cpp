// What free bodies cost: nanoseconds per body and frame of 1/60 s, from 100 to 100 000 bodies under
// gravity.
//
//   bench_flight_cost [rounds]
//
//   flights      the closed form alone, evaluated in a loop: nothing else is there
//   layer        the simulation layer, which looks whether anything acts
//   beside       the same bodies in a scene where another body has drag and two others a spring
//   separatrix   the layer, all bodies spinning close to their middle axis
//
// Rounds are interleaved; the medians are printed.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr int kFrames = 30;

std::vector<BodyDef> free_bodies(int n, bool near_separatrix) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto moment = [&] { return 1 + 0.5 * unit(random); };
  std::vector<BodyDef> bodies;
  for (int i = 0; i < n; ++i) {
    Vec3 s(moment(), moment(), moment());
    if (near_separatrix) std::sort(s.data(), s.data() + 3);
    BodyDef body =
        test::free_body("body" + std::to_string(i), 1, {s[1] + s[2], s[2] + s[0], s[0] + s[1]});
    body.angular_velocity = near_separatrix
                                ? Vec3(1e-3 * unit(random), 5, 1e-3 * unit(random))
                                : Vec3(5 * unit(random), 5 * unit(random), 5 * unit(random));
    body.linear_velocity = {unit(random), unit(random), unit(random)};
    bodies.push_back(body);
  }
  return bodies;
}

// Some other bodies on which something acts.
Scene beside_driven_ones(std::vector<BodyDef> bodies) {
  BodyDef dragged = test::free_body("dragged", 1, {1, 2, 3});
  dragged.drag.linear = 0.1;
  BodyDef hanging = test::free_body("hanging", 1, {1, 2, 3});
  bodies.push_back(dragged);
  bodies.push_back(hanging);
  Scene scene = test::scene(std::move(bodies));
  SpringDef spring;
  spring.a = "hanging";
  spring.point_b = {0, 0, 1};
  spring.stiffness = 100;
  scene.springs = {spring};
  return scene;
}

// Advances a layer, or its flights alone, and says what a body and frame took.
class Contender {
 public:
  Contender(const Scene& scene, int bodies, bool flights_only)
      : bodies_(bodies), flights_only_(flights_only), layer_(scene) {
    layer_.advance_to(1 / 60.0);
    if (!flights_only) return;
    for (Eigen::Index i = 0; i < layer_.world().size(); ++i)
      flights_.emplace_back(layer_.world(), i);
  }

  double nanoseconds() {
    const Elapsed start = Stopwatch::now();
    for (int k = 0; k < kFrames; ++k) advance(++frame_ / 60.0);
    return (Stopwatch::now().cpu_s - start.cpu_s) / kFrames / bodies_ * 1e9;
  }

 private:
  void advance(double t) {
    if (!flights_only_) return layer_.advance_to(t);
    World& world = layer_.world();
    for (std::size_t k = 0; k < flights_.size(); ++k)
      flights_[k].evaluate(world, static_cast<Eigen::Index>(k), t, world.y);
  }

  int bodies_;
  bool flights_only_;
  int frame_ = 1;
  SimulationLayer layer_;
  std::vector<Flight> flights_;
};

void compare(int bodies, int rounds) {
  const auto free = free_bodies(bodies, false);
  std::vector<Contender> all;
  all.reserve(4);
  all.emplace_back(test::scene(free), bodies, true);
  all.emplace_back(test::scene(free), bodies, false);
  all.emplace_back(beside_driven_ones(free), bodies, false);
  all.emplace_back(test::scene(free_bodies(bodies, true)), bodies, false);
  std::vector<std::vector<double>> times(all.size());
  for (int r = 0; r < rounds; ++r)
    for (std::size_t c = 0; c < all.size(); ++c) times[c].push_back(all[c].nanoseconds());
  std::printf("%8d", bodies);
  for (auto& t : times) {
    std::nth_element(t.begin(), t.begin() + rounds / 2, t.end());
    std::printf(" %11.0f", t[static_cast<std::size_t>(rounds / 2)]);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace poinsot

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  std::printf("ns of CPU per body and frame; 60 frames per second: x 0.06 = us per second\n");
  std::printf("%8s %11s %11s %11s %11s\n", "bodies", "flights", "layer", "beside", "separatrix");
  for (const int bodies : {100, 1000, 10000, 100000}) poinsot::compare(bodies, rounds);
}
