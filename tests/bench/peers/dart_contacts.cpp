// The contact scenes in DART: its two solvers, Dantzig's method first, which is the default, on the
// engine's own collision detector, whose boxes and spheres are exact and which has no planes: the
// ground is a box. It has no capsules and hulls either; scenes with such are refused.

#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <stdexcept>

#include "contact_measure.h"

namespace poinsot::bench {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Frame;
using dart::dynamics::FreeJoint;

dart::dynamics::ShapePtr shape_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape))
    return std::make_shared<dart::dynamics::BoxShape>(box->size);
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return std::make_shared<dart::dynamics::SphereShape>(sphere->radius);
  throw std::runtime_error("the engine's own detector has boxes and spheres only");
}

Eigen::Isometry3d transform(const Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(pose.c).rotate(pose.q);
  return result;
}

class Dart final : public ContactWorld {
 public:
  Dart(const ContactScene& c, bool direct, int steps) : friction_(c.friction), steps_(steps) {
    constexpr double kGroundSize = 400, kGroundDepth = 10;  // [m]
    auto solver = std::make_unique<dart::constraint::BoxedLcpConstraintSolver>();
    if (!direct) {
      solver->setBoxedLcpSolver(std::make_shared<dart::constraint::PgsBoxedLcpSolver>());
      solver->setSecondaryBoxedLcpSolver(nullptr);
    }
    world_->setConstraintSolver(std::move(solver));
    world_->getConstraintSolver()->setCollisionDetector(
        dart::collision::DARTCollisionDetector::create());
    world_->getConstraintSolver()->getCollisionOption().maxNumContacts = 10 * c.bodies.size() + 100;
    world_->setTimeStep(1 / (kFrameRate * steps));
    world_->setGravity({0, 0, -kGravity});
    for (const ContactBody& body : c.bodies) add_moving(body);
    for (const ContactBody& wall : c.walls) add_fixed(wall.shape, wall.pose);
    add_fixed(Box{{kGroundSize, kGroundSize, kGroundDepth}},
              {c.ground * Vec3(0, 0, -0.5 * kGroundDepth), c.ground});
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) world_->step();
  }

  void read(std::vector<ContactState>& states) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Eigen::Isometry3d& pose = bodies_[i]->getWorldTransform();
      states[i] = {{pose.translation(), Quat(pose.linear())},
                   bodies_[i]->getLinearVelocity(),
                   bodies_[i]->getAngularVelocity()};
    }
  }

 private:
  void add_shape(BodyNode* body, const Shape& shape) {
    auto* node =
        body->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(
            shape_of(shape));
    node->getDynamicsAspect()->setFrictionCoeff(friction_);
    node->getDynamicsAspect()->setRestitutionCoeff(0);
  }

  dart::dynamics::SkeletonPtr skeleton() {
    return dart::dynamics::Skeleton::create("body_" + std::to_string(count_++));
  }

  void add_moving(const ContactBody& def) {
    const auto one = skeleton();
    const auto [joint, body] = one->createJointAndBodyNodePair<FreeJoint>();
    const Mat3 J = def.moments.asDiagonal();
    body->setInertia(dart::dynamics::Inertia(def.mass, Vec3::Zero(), J));
    joint->setTransform(transform(def.pose));
    joint->setLinearVelocity(def.velocity, Frame::World(), Frame::World());
    add_shape(body, def.shape);
    world_->addSkeleton(one);
    bodies_.push_back(body);
  }

  void add_fixed(const Shape& shape, const Pose& pose) {
    const auto one = skeleton();
    const auto [joint, body] = one->createJointAndBodyNodePair<dart::dynamics::WeldJoint>();
    joint->setTransformFromParentBodyNode(transform(pose));
    add_shape(body, shape);
    one->setMobile(false);
    world_->addSkeleton(one);
  }

  double friction_;
  int steps_;
  int count_ = 0;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  std::vector<BodyNode*> bodies_;
};

std::vector<ContactSetting> settings(const ContactCase& c) {
  std::vector<ContactSetting> result;
  for (const bool direct : {true, false})
    for (const int steps : {1, 4, 17}) {
      if (c.question == Question::piles && steps > 1) continue;
      result.push_back(
          {std::string(direct ? "dantzig" : "pgs") + " 1/" + std::to_string(60 * steps),
           [direct, steps](const ContactScene& scene) {
             return std::make_unique<Dart>(scene, direct, steps);
           }});
    }
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure_contacts("dart", poinsot::bench::settings, argc, argv);
}
