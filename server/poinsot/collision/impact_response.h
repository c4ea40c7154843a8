// What happens when a pair meets: the impact of all bodies that touch one another at that instant,
// rigidly, with restitution and friction (../contact/impact.h).
//
// A bounce so low that the body would be back within `kRestFlight` of a sub-step does not happen:
// the infinite sequence of ever lower bounces ends there, with the acceleration that presses the
// pair together in place of g. README.md, section "Impacts".

#pragma once

#include "poinsot/collision/island.h"
#include "poinsot/contact/convex_newton.h"
#include "poinsot/contact/impact.h"

namespace poinsot {

class ImpactResponse {
 public:
  // The pair of `record` meets at t; `normal` and `point` are where. Brings the bodies that take
  // part to t, changes their momenta and courses, and adds to the result. If bodies outside the
  // island take part, that sleep or are in none (`island_of`), nothing is done but that they are
  // added to the island's strays.
  void resolve(CollisionState& state, Island& island, std::span<const int> island_of, int record,
               double t, SimulationWorker& worker);

  // Bodies whose course changed in the last call.
  std::span<const Eigen::Index> changed() const { return changed_; }

 private:
  void gather_cluster(CollisionState& state, Island& island, std::span<const int> island_of,
                      int record, double t, SimulationWorker& worker);
  bool touches(CollisionState& state, const PairRecord& record, double t, SimulationWorker& worker);
  void add_points(CollisionState& state, int record, double t, SimulationWorker& worker);
  int local(CollisionState& state, Eigen::Index column, double t, SimulationWorker& worker);
  double restitution(CollisionState& state, const PairRecord& record,
                     const ImpactPoint& point) const;
  double solve();
  double solve_plastic();
  void add_systems(const World& world);
  void tell(CollisionState& state, Island& island, double t);

  struct Range {
    int record;
    std::size_t first, end;  // of points_
  };

  ImpactSolver solver_;
  ConvexNewton plastic_solver_;  // of large clusters without restitution
  std::vector<Contact> contacts_;
  std::vector<double> targets_;
  std::vector<Eigen::Index> columns_;  // per local body
  std::vector<MovingPose> poses_;
  std::vector<ContactBody> bodies_, before_;
  std::vector<ImpactPoint> points_;
  std::vector<Range> ranges_;  // the records that touch
  std::vector<Eigen::Index> changed_;
  std::vector<Manifold> manifolds_;
};

}  // namespace poinsot
