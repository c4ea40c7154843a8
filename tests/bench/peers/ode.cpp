// The cases in ODE: its two steppers, and the quick one with finite rotation about the spin. The
// gyroscopic term is on, as it is by default; no auto-disable, no damping but the case's own.

#include <cmath>
#include <ode/ode.h>

#include "measure.h"

namespace poinsot::bench {
namespace {

struct Mode {
  std::string name;
  int (*step)(dWorldID, dReal);
  bool is_finite;
};
const std::vector<Mode> kModes = {{"step", dWorldStep, false},
                                  {"quick", dWorldQuickStep, false},
                                  {"quick-finite", dWorldQuickStep, true}};

class Ode final : public Simulation {
 public:
  Ode(const Case& c, const Mode& mode, int steps)
      : case_(c), mode_(mode), steps_(steps), h_(1 / (c.frame_rate * steps)) {
    dWorldSetGravity(world_, c.gravity.x(), c.gravity.y(), c.gravity.z());
    dWorldSetAutoDisableFlag(world_, 0);
    for (const CaseBody& body : c.bodies) add(body);
  }

  ~Ode() override { dWorldDestroy(world_); }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) {
      if (case_.has_wrench()) push();
      if (case_.spring) pull();
      mode_.step(world_, h_);
    }
  }

  void read(std::vector<Pose>& poses) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const dReal* c = dBodyGetPosition(bodies_[i]);
      const dReal* q = dBodyGetQuaternion(bodies_[i]);  // w x y z
      poses[i] = {Vec3(c[0], c[1], c[2]), Quat(q[0], q[1], q[2], q[3])};
    }
  }

 private:
  void add(const CaseBody& def) {
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    const Vec3& moments = def.moments;
    dMassSetParameters(&mass, def.mass, 0, 0, 0, moments.x(), moments.y(), moments.z(), 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, def.pose.c.x(), def.pose.c.y(), def.pose.c.z());
    const dQuaternion q = {def.pose.q.w(), def.pose.q.x(), def.pose.q.y(), def.pose.q.z()};
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, def.velocity.x(), def.velocity.y(), def.velocity.z());
    dBodySetAngularVel(body, def.omega.x(), def.omega.y(), def.omega.z());
    dBodySetFiniteRotationMode(body, mode_.is_finite ? 1 : 0);
    if (case_.drag > 0) {
      dBodySetLinearDamping(body, 1 - std::exp(-case_.drag / def.mass * h_));  // lost per step
      dBodySetLinearDampingThreshold(body, 0);
    }
    bodies_.push_back(body);
  }

  void push() {
    for (const dBodyID body : bodies_) {
      dBodyAddTorque(body, case_.torque_W.x(), case_.torque_W.y(), case_.torque_W.z());
      dBodyAddRelForce(body, case_.force_B.x(), case_.force_B.y(), case_.force_B.z());
    }
  }

  void pull() {
    for (const dBodyID body : bodies_) {
      const dReal* c = dBodyGetPosition(body);
      const Vec3 F = case_.spring->stiffness * (case_.spring->anchor_W - Vec3(c[0], c[1], c[2]));
      dBodyAddForce(body, F.x(), F.y(), F.z());
    }
  }

  const Case& case_;
  const Mode& mode_;
  int steps_;
  double h_;  // [s]
  dWorldID world_ = dWorldCreate();
  std::vector<dBodyID> bodies_;
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  for (const Mode& mode : kModes)
    for (const FixedStep& step : fixed_steps(c.bodies.size() == 1))
      result.push_back({mode.name + " " + step.name, [&c, &mode, n = step.per_frame] {
                          return std::make_unique<Ode>(c, mode, n);
                        }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return poinsot::bench::measure("ode", poinsot::bench::settings, argc, argv);
}
