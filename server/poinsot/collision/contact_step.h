// The standing contacts of a sub-step: finds the points of chosen pairs, moves apart what
// penetrates, and finds the impulses λ that act as forces λ/h until the sub-step ends, so that
// gravity, held wrenches and contact are integrated together.
//
// With impacts foreseen (crowded islands, and scenes without a search) pairs that would be through
// before the sub-step ends are slowed by an impulse to arrive exactly, and leave with restitution.
// README.md, section "A sub-step", gives the equations.

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "poinsot/collision/collision_state.h"
#include "poinsot/collision/point_motion.h"
#include "poinsot/contact/convex_newton.h"

namespace poinsot {

// Of the speed that a sub-step of gravity gives: slower approaches are at rest, and do not bounce.
inline constexpr double kRestingSteps = 2;

class ContactStep {
 public:
  struct Books {
    double impact_loss = 0;      // [J] kinetic energy that foreseen impacts took
    double push_out_energy = 0;  // [J] that push-out added
  };
  struct Outcome {
    std::uint32_t pushing = 0;   // points with an impulse
    double max_penetration = 0;  // [m] after push-out
    SolveResidual residual;      // of the forces
    int iterations = 0;          // of all solves: forces at every duration tried, impacts, push-out
  };

  explicit ContactStep(const CollisionDef& def);

  // A point of a pair that touches elsewhere, on its way in too fast to be held: its arrival is an
  // impact of its own, which the pair's other points do not foresee.
  struct Awaited {
    int record;  // of the state's pairs
    PairPoint point;
  };

  // Of the pairs that follow. If impacts are not foreseen, points on their way in are awaited, and
  // the sub-step is made shorter: to `usual` unless everything rests, and, if it `stops` for that,
  // to when a sliding pair comes to rest, or where bodies would turn too far for the scene's
  // tolerance.
  void begin(const CollisionState& state, double h, double usual, bool foresees, bool stops);
  // Whether the sub-step is shorter than usual because it stops.
  bool stopped() const { return stopped_; }
  // [s] of the sub-step that was solved.
  double duration() const { return h_; }
  void add(CollisionState& state, int record);
  std::size_t points() const { return contacts_.size(); }
  std::span<const Awaited> awaited() const { return awaited_; }

  // Moves bodies, changes momenta and fills the contact wrenches of the simulation layer.
  Outcome solve(CollisionState& state, Books& books);

  // Whether the bodies of the pairs added would stay at rest if they were: impulses inside their
  // cones are found that leave no body an acceleration above `sleep_acceleration`. The pairs keep
  // the impulses. Bounded work: what it did not find it may find when it is asked again.
  bool proves_rest(CollisionState& state);
  // Whether every one of these bodies is in a pair added.
  bool holds_all(const CollisionState& state, std::span<const Eigen::Index> bodies) const;

  // Part of h that the bodies may move on before one could pass through another: 1 if nothing
  // became faster than was foreseen or turns fast.
  double sound_part(const CollisionState& state) const;

  // The bodies that contacts act on, systems as a whole, ascending.
  std::span<const Eigen::Index> movers() const { return movers_; }
  std::span<const int> records() const { return records_; }
  bool acts_on(Eigen::Index column) const {
    return std::binary_search(movers_.begin(), movers_.end(), column);
  }
  // Of the k-th record added: whether a point pushes, and the least gap [m] when it was added.
  bool pushes(std::size_t k) const;
  double least_gap(std::size_t k) const;
  // Whether add() would find points of the record at all, by balls about its shapes.
  bool is_near(const CollisionState& state, int record);

 private:
  struct Point {
    int record;             // index into records_
    int index;              // into its points
    Vec3 position, normal;  // [m] in W, at the start of the sub-step
    PointMotion motion;
  };

  int local(const CollisionState& state, Eigen::Index column);
  double margin(const CollisionState& state, const PairRecord& record);
  bool comes_in(const CollisionState& state, const PairRecord& record, const PairPoint& p) const;
  void gather(const World& world);
  void push_out(CollisionState& state, Books& books);
  bool choose_targets(CollisionState& state);
  void foresee_impacts(CollisionState& state, Books& books);
  void resolve(CollisionState& state);
  void find_forces(const CollisionState& state, double h);
  void place_middle(const CollisionState& state, double h);
  void place_bodies(const CollisionState& state, double h);
  Vec3 slip_at_start(std::size_t i) const;
  void act(CollisionState& state);
  double shorter(const CollisionState& state, double h);
  double while_turning(const CollisionState& state, double h,
                       std::span<const ContactBody> bodies) const;
  double end_of_slip(const CollisionState& state, double h);
  void scale_impulses(double by);
  void set_duration(CollisionState& state, double h);
  void remember(CollisionState& state);
  void find_movers(const CollisionState& state);
  PairPoint& point(CollisionState& state, std::size_t i);

  CollisionDef def_;
  ConvexNewton solver_;
  double h_ = 0, usual_ = 0;
  double least_size_ = 0;  // [m] of the pairs added
  bool foresees_ = true, stops_ = false, stopped_ = false;
  std::vector<Awaited> awaited_;
  std::vector<int> local_of_;          // per column; −1: none
  std::vector<Eigen::Index> columns_;  // per local body
  std::vector<double> travel_, room_;  // [m] per local body: foreseen, and more that does no harm
  std::vector<ContactBody> bodies_, before_;
  std::vector<Velocity> acceleration_;  // per local body: of all that acts but contacts
  struct Slip {                         // of the pair that comes to rest first, at the last try
    int record = -1;
    double inv_h = 0, excess = 0;  // [1/s], [N] of friction over what its cone allows
  } slip_;
  SolveResidual residual_;
  int iterations_ = 0;
  std::vector<int> records_;
  std::vector<std::size_t> first_point_;  // per record, and the end
  std::vector<Point> points_;
  std::vector<Contact> contacts_, impacts_;
  std::vector<double> target_;  // [m/s] per contact
  std::vector<Eigen::Index> movers_;
  std::vector<double> fastest_;  // [m] per local body: travel after the impulses
};

}  // namespace poinsot
