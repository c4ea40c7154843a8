#include "faults/witness.h"

#include <chrono>

#include "poinsot/client/client.h"
#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot::faults {

using namespace std::chrono_literals;

std::vector<std::uint64_t> undisturbed_hashes(const std::string& scene, std::uint64_t frames) {
  PresentationLayer run(read_scene_file(scene));
  std::vector<std::uint64_t> hashes = {run.snapshot().state_hash};
  while (run.frame() < frames) {
    run.advance_frame();
    hashes.push_back(run.snapshot().state_hash);
  }
  return hashes;
}

Witness::Witness(int domain, const std::string& world, bool lan)
    : thread_([=, this](const std::stop_token& stop) { run(stop, domain, world, lan); }) {}

Witness::~Witness() = default;

void Witness::run(const std::stop_token& stop, int domain, const std::string& world, bool lan) {
  Client client({.world = world, .domain = domain, .lan = lan});
  PoseSnapshot snapshot;
  while (!stop.stop_requested()) {
    if (!client.next_poses(snapshot, 100ms)) continue;
    const std::lock_guard lock(mutex_);
    if (snapshot.session != session_) seen_.clear();
    session_ = snapshot.session;
    frame_ = snapshot.frame;
    seen_[snapshot.frame] = snapshot.state_hash;
  }
}

std::map<std::uint64_t, std::uint64_t> Witness::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

std::uint64_t Witness::session() const {
  const std::lock_guard lock(mutex_);
  return session_;
}

std::uint64_t Witness::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

}  // namespace poinsot::faults
