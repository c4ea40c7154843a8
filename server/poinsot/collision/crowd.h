// The crowd: bodies whose contacts are stepped by soft_step (crowd_step.h). This is who is in it,
// and what they may touch.
//
// An island joins the crowd if the scene asks for it, or if `auto` finds it easy enough
// for the accuracy that is asked for, or too large for anything else. Pairs of the crowd are not
// searched for impacts: their points foresee them.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/parallel.h"
#include "poinsot/collision/crowd_step.h"

namespace poinsot {

// Records and bodies that a thread takes at a time; so few that waking a thread would take longer
// stay on the caller's.
template <class Task>
void run_chunks(Team& team, std::size_t count, const Task& task) {
  constexpr std::size_t kTogether = 64, kFew = 512;
  if (count <= kFew) {
    for (std::size_t k = 0; k < count; ++k) task(k);
    return;
  }
  team.run((count + kTogether - 1) / kTogether, [&](std::size_t chunk, int) {
    const std::size_t end = std::min(count, (chunk + 1) * kTogether);
    for (std::size_t k = chunk * kTogether; k < end; ++k) task(k);
  });
}

// Larger islands are not solved directly, not even to prove that they rest.
inline constexpr std::size_t kMostDirect = 400;

// No point of body i, which turns at `omega` [rad/s], moves farther in h [s], contacts aside [m].
double crowd_travel(const CollisionState& state, Eigen::Index i, const Vec3& omega, double h);

class Crowd {
 public:
  explicit Crowd(const CollisionState& state);

  // Body i came, went, or begins anew; the shapes of bodies are others.
  void set_body(const CollisionState& state, Eigen::Index i);
  void fit_to_shapes(const CollisionState& state);

  // Whether a body was in the crowd in the last frame, or is likely to be: its pairs are not
  // searched before islands are parted.
  bool has(Eigen::Index i) const { return member_[static_cast<std::size_t>(i)] != 0; }
  void set_member(Eigen::Index i, bool member);
  // Something else acts on body i from now on, not only held wrenches.
  void look_at_forces(const World& world, Eigen::Index i);

  // What the shapes of its bodies may touch before `h` [s] have passed …
  void look(const CollisionState& state, double h, Team& team);
  // … whether the boxes of body i hold that …
  bool fits(Eigen::Index i) const { return fits_[static_cast<std::size_t>(i)] != 0; }
  // … and which of its pairs do not touch in this frame.
  void find_idle(CollisionState& state, Team& team) const;
  // A box for a collider of such a body that is likely to last for some frames.
  Aabb roomy_box(const CollisionState& state, const Collider& collider, double h) const;

  // Whether bodies are in the crowd unless something speaks against it.
  bool is_usual() const { return usual_; }
  // Whether bodies that touch nothing are in it too: if there are many, their impacts are not worth
  // a search.
  bool is_everybody() const { return everybody_; }
  // What body i is in is stepped with the crowd in this frame and some more, if it can be.
  void force(Eigen::Index i) {
    constexpr std::uint64_t kFrames = 20;
    forced_[static_cast<std::size_t>(i)] = frame_ + kFrames;
  }
  bool is_forced(const Island& island) const;
  void next_frame();
  // Whether it was a member when the frame began.
  bool had(Eigen::Index i) const { return before_[static_cast<std::size_t>(i)] != 0; }

  // Whether soft_step knows all that acts on an island, and the crowd all its shapes.
  bool may_step(const CollisionState& state, const Island& island) const;
  // Adds what a continuation depends on.
  void hash_into(Hash64& hash) const;
  template <class Archive>
  void archive(Archive& with);
  // Whether an island is stepped with the crowd in the frame that begins. `strain` per body:
  // of the last step (CrowdStep).
  bool takes(const CollisionState& state, const Island& island, std::span<const double> strain,
             double duration);

 private:
  bool look(const CollisionState& state, Eigen::Index i, double h);
  bool is_near(const CollisionState& state, const PairRecord& record) const;
  std::size_t count_standing(const CollisionState& state, const Island& island);
  bool is_easy(const CollisionState& state, const Island& island);
  bool is_shallow(const CollisionState& state, const Island& island);

  bool everybody_ = false;
  bool always_ = false;               // whatever there is
  bool usual_ = false;                // bodies are in the crowd unless something speaks against it
  std::vector<std::uint8_t> member_;  // per body
  std::vector<std::uint8_t> before_;  // per body: member_ when the frame began
  std::vector<std::uint8_t> may_step_;  // per body: nothing acts on it that soft_step does not know
  std::vector<std::uint8_t> counted_;   // per body: the same, tethers and quarantine aside
  std::size_t count_ = 0;               // of them
  std::vector<std::uint8_t> looked_;    // per body: it was looked at in this frame, so that …
  std::vector<std::uint8_t> fits_;      // … this holds
  enum class Kind : std::uint8_t { solid, plane, mesh };
  std::vector<Kind> kind_;  // per collider: close together
  bool has_mesh_ = false;
  std::vector<Aabb> near_;  // per collider of a body that was

  std::vector<int> level_;  // per body: of a stack, while it is counted
  std::uint64_t frame_ = 1;
  std::vector<std::uint64_t> forced_;  // per body: the frame until which it is
  std::vector<int> promoted_;          // per body: frames for which it is solved directly
};

}  // namespace poinsot
