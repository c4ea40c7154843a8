// The scene of a run, as bodies come and go in it: which places are taken, and by whom.
//
// A place that a body leaves is absent and keeps its generation; the next body takes the first
// absent place with the next generation, or a new place at the end. Who has shared the scene keeps
// what it got: the next change is made to a copy.

#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>

#include "poinsot/base/archive.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

class LivingScene {
 public:
  explicit LivingScene(Scene scene);

  const Scene& now() const { return *scene_; }
  const Scene& original() const { return *original_; }
  // The scene as it is now, never to be changed.
  std::shared_ptr<const Scene> share() const;

  // From 1; another one when bodies came, went, or static ones were moved.
  std::uint32_t revision() const { return revision_; }
  std::size_t bodies() const { return now().bodies.size() - absent_.size(); }
  // Whether the body at a place has been there since the start.
  bool is_original(std::size_t place) const;
  // Of all that came and went since the start, in order; 0: nothing did.
  std::uint64_t digest() const { return digest_; }

  // Gives the body its generation, and its place.
  std::size_t add(BodyDef& body);
  // Springs and wrenches of the scene that name the body go with it; rules of pairs stay, for
  // whoever has these names.
  void remove(std::size_t place);
  // Pose and velocities of a body as those at time 0.
  void set_start(std::size_t place, const Pose& pose, const Vec3& linear_velocity,
                 const Vec3& angular_velocity);
  void move_static(std::size_t place, const Pose& pose);

  // The scene is the original one again.
  void start_afresh();

  // What a checkpoint keeps beside the scene: also the original, if that is another.
  void save(ByteWriter& out) const;
  // Throws Error if the bytes are damaged; this is then to be thrown away.
  void restore(ByteReader& in, std::shared_ptr<const Scene> scene);

 private:
  Scene& change();
  void find_absent();
  void become(std::shared_ptr<const Scene> scene, std::uint64_t digest);
  const std::string& original_bytes() const;

  std::shared_ptr<const Scene> original_;
  mutable std::shared_ptr<const std::string> original_bytes_;  // once asked for
  std::shared_ptr<const Scene> scene_;
  mutable bool is_shared_ = true;  // also with original_
  bool rests_are_fixed_ = false;   // every spring has a rest length of its own
  std::set<std::size_t> absent_;
  std::uint32_t revision_ = 1;
  std::uint64_t digest_ = 0;
};

}  // namespace poinsot
