#include "poinsot/collision/collision_layer.h"

#include <cmath>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/collision/frame_motion.h"

namespace poinsot {
namespace {

// Shares the CPU time of a frame among the layers as they shared its wall time. Reading the CPU
// clock takes a system call, too dear for every short frame: then it is taken as a part of the wall
// time, which now and then is measured.
class FrameTimes {
 public:
  FrameTimes(CollisionTimes& times, CpuShare& share)
      : times_(times), before_(times), share_(share) {
    constexpr double kShort = 1e-4;  // [s]
    constexpr unsigned kMeasureEvery = 16;
    measures_ = share.last_wall_s > kShort || share.frames++ % kMeasureEvery == 0;
    if (measures_) start_ = Stopwatch::now();
  }
  ~FrameTimes() {
    const double wall = wall_of(times_) - wall_of(before_);
    share_.last_wall_s = wall;
    if (wall <= 0) return;
    if (measures_) share_.cpu_per_wall = (Stopwatch::now().cpu_s - start_.cpu_s) / wall;
    const auto share = [&](Elapsed& now, const Elapsed& before) {
      now.cpu_s += share_.cpu_per_wall * (now.wall_s - before.wall_s);
    };
    share(times_.collision, before_.collision);
    share(times_.contact, before_.contact);
    share(times_.simulation, before_.simulation);
  }
  FrameTimes(const FrameTimes&) = delete;
  FrameTimes& operator=(const FrameTimes&) = delete;

 private:
  static double wall_of(const CollisionTimes& t) {
    return t.collision.wall_s + t.contact.wall_s + t.simulation.wall_s;
  }

  CollisionTimes& times_;
  CollisionTimes before_;
  CpuShare& share_;
  bool measures_;
  Elapsed start_;
};

}  // namespace

struct CollisionLayer::Frame {
  explicit Frame(const Scene& scene) : motion(scene) {}
  FrameMotion motion;
};

CollisionLayer::CollisionLayer(const Scene& scene)
    : frame_(std::make_unique<Frame>(scene)), energy_scale_(world()), start_energy_(energy()) {}

CollisionLayer::~CollisionLayer() = default;
CollisionLayer::CollisionLayer(CollisionLayer&&) noexcept = default;
CollisionLayer& CollisionLayer::operator=(CollisionLayer&&) noexcept = default;

World& CollisionLayer::world() {
  frame_->motion.touch();
  return frame_->motion.state().simulation.world();
}
const World& CollisionLayer::world() const {
  return simulation().world();
}
const SimulationLayer& CollisionLayer::simulation() const {
  return std::as_const(frame_->motion).state().simulation;
}
bool CollisionLayer::is_asleep(Eigen::Index i) const {
  return std::as_const(frame_->motion).state().asleep[static_cast<std::size_t>(i)] != 0;
}

void CollisionLayer::contact_forces(std::vector<ContactForce>& forces) const {
  std::as_const(*frame_).motion.contact_forces(forces);
}

std::uint32_t CollisionLayer::course_stamp(Eigen::Index i) const {
  return std::as_const(frame_->motion).state().stamp[static_cast<std::size_t>(i)];
}

void CollisionLayer::advance_to(double t_end) {
  {
    const FrameTimes frame_times(times_, cpu_share_);
    frame_->motion.advance_to(t_end, report_, impacts_, times_);
  }
  if (simulation().quarantined() != quarantined_) rebase_energy();
}

// A frozen body takes its energy with it: the balance of the others starts afresh.
void CollisionLayer::rebase_energy() {
  quarantined_ = simulation().quarantined();
  start_energy_ += energy() - expected_energy();
}

double CollisionLayer::expected_energy() const {
  return start_energy_ + simulation().work() - report_.impact_loss + report_.push_out_energy;
}

double CollisionLayer::energy() const {
  return kinetic_energy(world()) + potential_energy(world());
}

EnergyBalance CollisionLayer::energy_balance() {
  const World& now = std::as_const(*this).world();
  if (scale_is_old_) energy_scale_.widen(now);
  scale_is_old_ = false;
  const double kinetic = kinetic_energy(now);
  energy_scale_.see(kinetic);
  const double energy = kinetic + potential_energy(now);
  const double scale = energy_scale_.value();
  return {energy, scale > 0 ? (energy - expected_energy()) / scale : 0};
}

void CollisionLayer::hash_into(Hash64& hash) const {
  std::as_const(*frame_).motion.hash_into(hash);
}

Eigen::Index CollisionLayer::spawn(const BodyDef& body) {
  const double before = spring_energy(std::as_const(*this).world());
  const Eigen::Index i = frame_->motion.spawn(body);
  take_as_given(energy_about(i) - before);
  return i;
}

void CollisionLayer::remove(Eigen::Index i) {
  const double before = energy_about(i);
  frame_->motion.remove(i);
  take_as_given(energy_about(i) - before);
}

void CollisionLayer::set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity) {
  const double before = energy_about(i);
  frame_->motion.set_state(i, pose, velocity);
  take_as_given(energy_about(i) - before);
}

void CollisionLayer::kick(Eigen::Index i, const Wrench& impulse) {
  frame_->motion.kick(i, impulse);
}

// All that a change of body i may change.
double CollisionLayer::energy_about(Eigen::Index i) const {
  return kinetic_energy(world(), i) + potential_energy(world(), i) + spring_energy(world());
}

// Energy that came, or went, by a change from outside: no error of the motion.
void CollisionLayer::take_as_given(double energy) {
  start_energy_ += energy;
  scale_is_old_ = true;
}

void CollisionLayer::set_tethers(std::span<const Tether> tethers) {
  frame_->motion.set_tethers(tethers);
  energy_scale_.see(tether_energy(std::as_const(*this).world()));  // it is a part of what flows
}

template <class Archive>
void CollisionLayer::archive(Archive& with) {
  with(frame_->motion, report_, energy_scale_, scale_is_old_, start_energy_, quarantined_);
}

void CollisionLayer::save(ByteWriter& out) const {
  const_cast<CollisionLayer*>(this)->archive(out);  // a writer changes nothing
}

void CollisionLayer::restore(ByteReader& in) {
  impacts_.clear();  // of a frame that is over
  archive(in);
}

}  // namespace poinsot
