// The cases in DART: a free joint per body and the engine's one stepper. Drag and springs are
// damping and stiffness of the joint's three translations, which the engine treats implicitly.

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>

#include "measure.h"

namespace poinsot::bench {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Frame;
using dart::dynamics::FreeJoint;

class Dart final : public Simulation {
 public:
  Dart(const Case& c, int steps) : case_(c), steps_(steps) {
    world_->setTimeStep(1 / (c.frame_rate * steps));
    world_->setGravity(c.gravity);
    for (const CaseBody& body : c.bodies) add(body);
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) {
      if (case_.has_wrench()) push();
      world_->step();
    }
  }

  void read(std::vector<Pose>& poses) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Eigen::Isometry3d& pose = bodies_[i]->getWorldTransform();
      poses[i] = {pose.translation(), Quat(pose.linear())};
    }
  }

 private:
  void add(const CaseBody& def) {
    auto skeleton = dart::dynamics::Skeleton::create("body_" + std::to_string(bodies_.size()));
    const auto [joint, body] = skeleton->createJointAndBodyNodePair<FreeJoint>();
    const Mat3 J = def.moments.asDiagonal();
    body->setInertia(dart::dynamics::Inertia(def.mass, Vec3::Zero(), J));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(def.pose.c).rotate(def.pose.q);
    joint->setTransform(pose);
    joint->setLinearVelocity(def.velocity, Frame::World(), Frame::World());
    joint->setAngularVelocity(def.omega, Frame::World(), Frame::World());
    for (std::size_t axis = 3; axis < 6; ++axis) {
      joint->setDampingCoefficient(axis, case_.drag);
      if (!case_.spring) continue;
      joint->setSpringStiffness(axis, case_.spring->stiffness);
      joint->setRestPosition(axis, case_.spring->anchor_W[static_cast<Eigen::Index>(axis - 3)]);
    }
    world_->addSkeleton(skeleton);
    bodies_.push_back(body);
  }

  void push() {
    for (BodyNode* body : bodies_) {
      body->addExtTorque(case_.torque_W, false);
      body->addExtForce(case_.force_B, Vec3::Zero(), true, true);
    }
  }

  const Case& case_;
  int steps_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  std::vector<BodyNode*> bodies_;
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  for (const FixedStep& step : fixed_steps(c.bodies.size() == 1))
    result.push_back({"default " + step.name,
                      [&c, n = step.per_frame] { return std::make_unique<Dart>(c, n); }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure("dart", poinsot::bench::settings, argc, argv);
}
