// How an island gets to the end of the frame.
//
// While nothing in it touches for long, its bodies keep to their courses from impact to impact.
// While contacts last, it goes in sub-steps of at most `contact_step`, cut where a new impact is.
// When there are more impacts than it pays to stop for, it is crowded: the rest of the frame goes
// in sub-steps whose contacts foresee impacts, no longer than in which nothing can pass through.

#pragma once

#include "poinsot/collision/contact_step.h"
#include "poinsot/collision/impact_response.h"
#include "poinsot/collision/island.h"

namespace poinsot {

// One thread's means.
class IslandMotion {
 public:
  explicit IslandMotion(const CollisionState& state) : worker_(state.world()), step_(state.def) {}

  // From the world's time to t_end, or until a body strays. `island_of` per body, of this
  // frame.
  void advance(CollisionState& state, Island& island, double t_end, std::span<const int> island_of);

  // Brings what is known of a pair up to `to`, from t on; `lasting`: how long its courses hold.
  void search(CollisionState& state, PairRecord& record, double t, double to, double lasting,
              bool in_contact, SearchWork& work);

  // The same unless it is known already, before the islands are parted.
  void look_ahead(CollisionState& state, PairRecord& record, double t, double to, double lasting,
                  SearchWork& work);

  // Whether the island would stay at rest if it were (ContactStep::proves_rest).
  bool proves_rest(CollisionState& state, const Island& island);

  SimulationWorker& worker() { return worker_; }
  bool watches = true;        // for bodies that stray; if not, the island goes to the end as it is
  double contact_wall_s = 0;  // [s] spent in contacts

 private:
  struct Meet {
    int record = -1;
    double time = 0;
    bool rests = false;  // a pair was found to have come to rest: contacts have to be stepped
  };
  struct Frame {
    CollisionState& state;
    Island& island;
    double t_end;
    std::span<const int> island_of;
    int id;
    double budget;   // impacts left to locate while contacts last …
    double stops;    // to make for the sake of accuracy
    double flights;  // … and while none does: then only the bodies that meet have to stop
    bool crowded;
  };

  double fly(Frame& frame, double t);
  double step_standing(Frame& frame, double t);
  double step_foreseeing(Frame& frame, double t);
  Meet first_meeting(Frame& frame, double t, double to, bool in_contact);
  bool rests(const Frame& frame) const;
  bool is_slow(Frame& frame, const PairRecord& record, double t, double h);
  bool afford(Frame& frame, double& budget, double cost);
  void meet(Frame& frame, const Meet& at);
  void join_touching(Frame& frame, double t);
  void await_points(Frame& frame, double t, Meet& first);
  void advance_movers(Frame& frame, double t, double to);
  void watch(Frame& frame, Eigen::Index i, double t);
  void note(Frame& frame, const ContactStep::Outcome& outcome, const ContactStep::Books& books);
  double sound_part(const CollisionState& state, double h) const;
  void bring_all(Frame& frame, double t);

  SearchResult search_mesh(CollisionState& state, const CoursePair& pair, const SearchSpan& span,
                           SearchWork& work);

  SimulationWorker worker_;
  std::vector<int> triangles_;
  std::vector<Manifold> manifolds_;
  ContactStep step_;
  ImpactResponse response_;
};

}  // namespace poinsot
