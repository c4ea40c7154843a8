// What one client holds, or the scene.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// A command that was accepted: everything that depended on that moment is resolved.
struct Held {
  std::uint64_t seq = 0;
  std::uint64_t first_frame = 0;
  std::uint64_t last_frame = 0;
  Eigen::Index column = 0;
  std::uint32_t slot = 0;
  WrenchKind kind = WrenchKind::force;
  Axes axes = Axes::world;  // of force and torque
  bool outlives_client = false;
  Vec3 force = Vec3::Zero();   // [N]; of an impulse [N·s]
  Vec3 torque = Vec3::Zero();  // [N·m] free couple; of an impulse [N·m·s]
  Vec3 p_B = Vec3::Zero();     // [m] point of action from the centre of mass, in B
  Vec3 target = Vec3::Zero();  // [m] of a tether, in W
  double stiffness = 0;        // [N/m]
  double damping = 0;          // [N·s/m]

  bool acts_in(std::uint64_t frame) const { return first_frame <= frame && frame <= last_frame; }
  // The first frame after `frame` in which it begins to act or acts no more.
  std::uint64_t changes_after(std::uint64_t frame) const {
    if (frame < first_frame) return first_frame;
    return last_frame == kForever ? kForever : last_frame + 1;
  }

  template <class Archive>
  void archive(Archive& with) {
    with(seq, first_frame, last_frame, column, slot);
    with.choice(kind, WrenchKind::tether);
    with.choice(axes, Axes::body);
    with(outlives_client, force, torque, p_B, target, stiffness, damping);
  }
};

// A set of kinds of wrenches, as bits.
using KindSet = std::uint8_t;
inline constexpr std::size_t kWrenchKinds = kWrenchKindNames.size();
constexpr KindSet set_of(WrenchKind kind) {
  return static_cast<KindSet>(1U << static_cast<unsigned>(kind));
}

// Which of them: those in a slot (0: any) and on a body (none: any).
struct Selection {
  std::uint32_t slot = 0;
  std::optional<Eigen::Index> column = {};
};

class HeldOfClient {
 public:
  // In the order of seq. What is over may still be among them until sweep().
  const std::vector<Held>& items() const { return items_; }
  std::size_t count(WrenchKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  // Those that are not over.
  std::size_t size() const { return live_; }

  void add(const Held& held);

  // Ends what is selected before `frame`, so that what begins then or later never acts. `next` is
  // the frame that will be advanced next. Tells the kinds that were concerned.
  KindSet end(const Selection& selection, std::uint64_t frame, std::uint64_t next);
  // How many of them would be over at once.
  std::size_t count_over(const Selection& selection, std::uint64_t frame, std::uint64_t next) const;
  // Ends at once what does not outlive the client.
  KindSet release();

  // Forgets what is over, and tells whether there was something.
  bool sweep(std::uint64_t next);
  std::uint64_t next_end() const { return next_end_; }  // first frame for which sweep() has work

  std::uint64_t digest() const;

 private:
  struct Tag {  // what is looked for, densely
    std::uint32_t slot, column;
  };
  bool matches(std::size_t k, const Selection& selection) const;
  void end_item(Held& held, std::uint64_t last, std::uint64_t next);

  std::vector<Held> items_;
  std::vector<Tag> tags_;  // of items_
  std::array<std::size_t, kWrenchKinds> counts_ = {};
  std::size_t live_ = 0;
  std::uint64_t next_end_ = kForever;
  mutable std::uint64_t digest_ = 0;  // 0: to be formed
};

}  // namespace poinsot
