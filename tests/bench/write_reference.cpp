// bench_write_reference FILE: the poses of all cases at all outputs, computed in extended
// precision.

#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

#include "reference_file.h"
#include "support/extended_reference.h"

namespace poinsot::bench {
namespace {

test::ExtendedReference reference(const Case& c, const CaseBody& body) {
  test::ReferenceBody def;
  def.mass = body.mass;
  def.J_B = body.moments.asDiagonal();
  def.gravity = c.gravity;
  def.held.in_W.torque = c.torque_W;
  def.held.in_B.force = c.force_B;
  def.drag_linear = c.drag;
  if (c.spring) def.springs = {{.point_W = c.spring->anchor_W, .stiffness = c.spring->stiffness}};
  return test::reference_of(def, body.pose.c, body.pose.q, body.velocity, body.omega);
}

std::vector<Pose> poses(const Case& c) {
  const std::size_t n = c.bodies.size();
  std::vector<Pose> result(static_cast<std::size_t>(c.frames()) * n);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      test::ExtendedReference body = reference(c, c.bodies[i]);
      for (int frame = 1; frame <= c.frames(); ++frame) {
        body.advance_to(frame / c.frame_rate);
        result[static_cast<std::size_t>(frame - 1) * n + i] = {body.position(), body.orientation()};
      }
    }
  };
  std::vector<std::jthread> team(std::max(1u, std::thread::hardware_concurrency()));
  for (std::jthread& member : team) member = std::jthread(work);
  team.clear();
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_write_reference FILE\n");
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  for (const poinsot::bench::Case& c : poinsot::bench::cases())
    poinsot::bench::write_reference(file, poinsot::bench::poses(c));
  file.close();
  if (!file) std::fprintf(stderr, "cannot write %s\n", argv[1]);
  return file ? 0 : 1;
}
