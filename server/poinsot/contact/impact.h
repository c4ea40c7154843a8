// What rigid bodies do to one another at the instant of an impact.
//
// After it no point approaches (n·v ≥ 0 to rounding), impulses push and stay in their circular
// Coulomb cones |pt| ≤ μ pn, they come in opposite pairs along one line (momentum is kept to
// rounding), and no energy is gained at the points, with friction too. The outcome does not depend
// on the order of the points (to rounding; with friction to 1e-6), and equal input gives equal
// bits.
//
// Points that share no moving body are independent impacts. One point alone is Stronge's impact
// (the work of restitution is e² that of compression; without coupling this is Newton's and
// Poisson's law too), with slip followed through the impulse. Points that share a body are resolved
// at once: generalized reflections for e = 1, blended with the inelastic impact below it. Equations
// and sources: README.md.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/contact.h"
#include "poinsot/contact/simultaneous_impact.h"

namespace poinsot {

// One touching point at the instant of an impact. Either body may be one that does not move (zero
// inverse mass and inertia); its velocity counts.
struct ImpactPoint {
  int a = 0, b = 0;             // bodies
  Vec3 point;                   // [m] in W
  Vec3 normal;                  // unit, in W, from b to a
  double restitution = 0;       // 0 … 1
  double friction = 0;          // ≥ 0
  Vec3 impulse = Vec3::Zero();  // out: on a, its opposite on b [N·s], in W
};

struct ImpactOutcome {
  // [J] at the points, ≥ 0 up to rounding: what the moving bodies lose, plus what bodies with a
  // prescribed motion put in.
  double energy_lost = 0;
  // False: the passes ran out and the rest of the impact was taken as inelastic, friction was not
  // found to its tolerance, or the input was not finite (then nothing is changed). All other
  // promises hold.
  bool converged = true;
  int passes = 0;  // of simultaneous reflections, all groups together
};

class ImpactSolver {
 public:
  // Changes the velocities of the bodies and sets the impulses of the points. Points that touch
  // without approaching belong in the list: the impact may press on them. Does not allocate once
  // it has seen as many bodies and points.
  ImpactOutcome resolve(std::span<ContactBody> bodies, std::span<ImpactPoint> points);

 private:
  // Points joined by moving bodies: the first point of point i's group.
  int group_of(int point);
  void find_groups(std::span<const ContactBody> bodies, std::span<const ImpactPoint> points);
  // The group's system; false: a number is not finite or nothing can move at a point.
  bool assemble(std::span<const ContactBody> bodies, std::span<const ImpactPoint> points);
  void resolve_group(std::span<ContactBody> bodies, std::span<ImpactPoint> points,
                     ImpactOutcome& outcome);

  SimultaneousImpact simultaneous_;
  std::vector<int> parent_;        // of points, union-find
  std::vector<int> last_of_body_;  // the last point seen at a body; −1 none
  std::vector<int> order_;         // points, group by group
  std::span<const int> members_;   // of the group at hand
  std::vector<double> inverse_mass_, speed_, impulse_, restitution_, friction_;
  std::vector<Mat3> frames_;  // columns: two tangents and the normal
};

}  // namespace poinsot
