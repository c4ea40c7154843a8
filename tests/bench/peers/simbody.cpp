// The cases in Simbody: Runge, Kutta and Merson's method with error control, the engine's usual
// choice, over its accuracies. The wrench is a force element of its own, evaluated wherever the
// integrator asks.

#include <SimTKsimbody.h>

#include "measure.h"

namespace poinsot::bench {
namespace {

SimTK::Vec3 tk(const Vec3& a) {
  return {a.x(), a.y(), a.z()};
}

class Push final : public SimTK::Force::Custom::Implementation {
 public:
  Push(const SimTK::MobilizedBody& body, const Case& c)
      : body_(body), torque_W_(tk(c.torque_W)), force_B_(tk(c.force_B)) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& bodies,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
    bodies[body_.getMobilizedBodyIndex()] +=
        SimTK::SpatialVec(torque_W_, body_.getBodyRotation(state) * force_B_);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }
  bool dependsOnlyOnPositions() const override { return true; }

 private:
  SimTK::MobilizedBody body_;
  SimTK::Vec3 torque_W_, force_B_;
};

class Simbody final : public Simulation {
 public:
  Simbody(const Case& c, double accuracy) : case_(c) {
    if (!c.gravity.isZero(0)) SimTK::Force::UniformGravity(forces_, matter_, tk(c.gravity));
    for (const CaseBody& body : c.bodies) add(body);
    SimTK::State state = system_.realizeTopology();
    for (std::size_t i = 0; i < c.bodies.size(); ++i) place(c.bodies[i], bodies_[i], state);
    integrator_.setAccuracy(accuracy);
    stepper_.initialize(state);
  }

  // Ends a step at every output: more accurate than interpolated outputs, and not dearer.
  void advance_to(double t) override { stepper_.stepTo(t); }

  void read(std::vector<Pose>& poses) const override {
    const SimTK::State& state = integrator_.getState();
    system_.realize(state, SimTK::Stage::Position);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const SimTK::Transform& pose = bodies_[i].getBodyTransform(state);
      const SimTK::Quaternion q = pose.R().convertRotationToQuaternion();  // w x y z
      poses[i] = {Vec3(pose.p()[0], pose.p()[1], pose.p()[2]), Quat(q[0], q[1], q[2], q[3])};
    }
  }

 private:
  void add(const CaseBody& def) {
    const Vec3& J = def.moments;
    const SimTK::Body::Rigid rigid(
        SimTK::MassProperties(def.mass, SimTK::Vec3(0), SimTK::Inertia(J.x(), J.y(), J.z())));
    const SimTK::MobilizedBody::Free body(matter_.Ground(), rigid);
    if (case_.has_wrench()) SimTK::Force::Custom(forces_, new Push(body, case_));
    for (int axis = 3; axis < 6 && case_.drag > 0; ++axis)  // the translations
      SimTK::Force::MobilityLinearDamper(forces_, body, SimTK::MobilizerUIndex(axis), case_.drag);
    if (case_.spring)
      SimTK::Force::TwoPointLinearSpring(forces_, matter_.Ground(), tk(case_.spring->anchor_W),
                                         body, SimTK::Vec3(0), case_.spring->stiffness, 0);
    bodies_.push_back(body);
  }

  void place(const CaseBody& def, const SimTK::MobilizedBody& body, SimTK::State& state) {
    const Quat& q = def.pose.q;
    const SimTK::Rotation R(SimTK::Quaternion(q.w(), q.x(), q.y(), q.z()));
    body.setQToFitTransform(state, SimTK::Transform(R, tk(def.pose.c)));
    body.setUToFitVelocity(state, SimTK::SpatialVec(tk(def.omega), tk(def.velocity)));
  }

  const Case& case_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  std::vector<SimTK::MobilizedBody> bodies_;
  SimTK::RungeKuttaMersonIntegrator integrator_{system_};
  SimTK::TimeStepper stepper_{system_, integrator_};
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  for (const int digits : {3, 6, 9, 12})
    result.push_back({"Merson 1e-" + std::to_string(digits), [&c, digits] {
                        return std::make_unique<Simbody>(c, std::pow(10, -digits));
                      }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure("simbody", poinsot::bench::settings, argc, argv);
}
