// The cases in Bullet (double precision): one step of the engine per sub-step, no sleeping, no
// damping but the case's own. The gyroscopic modes are the engine's three; the first is its
// default.

#include <btBulletDynamicsCommon.h>
#include <cmath>

#include "measure.h"

namespace poinsot::bench {
namespace {

btVector3 bt(const Vec3& a) {
  return {a.x(), a.y(), a.z()};
}

struct Mode {
  std::string name;
  int flag;
};
const std::vector<Mode> kModes = {{"gyro-body", BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY},
                                  {"gyro-explicit", BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT}};

class Bullet final : public Simulation {
 public:
  Bullet(const Case& c, int flag, int steps)
      : case_(c), steps_(steps), h_(1 / (c.frame_rate * steps)) {
    world_.setGravity(bt(c.gravity));
    for (const CaseBody& body : c.bodies) add(body, flag);
  }

  ~Bullet() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) {
      if (case_.has_wrench()) push();
      if (case_.spring) pull();
      world_.stepSimulation(h_, 0);
    }
  }

  void read(std::vector<Pose>& poses) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const btTransform& pose = bodies_[i]->getCenterOfMassTransform();
      const btQuaternion q = bodies_[i]->getOrientation();
      poses[i] = {Vec3(pose.getOrigin().x(), pose.getOrigin().y(), pose.getOrigin().z()),
                  Quat(q.w(), q.x(), q.y(), q.z())};
    }
  }

 private:
  void add(const CaseBody& def, int flag) {
    const Quat& q = def.pose.q;
    btRigidBody::btRigidBodyConstructionInfo info(def.mass, nullptr, &shape_, bt(def.moments));
    info.m_startWorldTransform =
        btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), bt(def.pose.c));
    info.m_linearDamping = 1 - std::exp(-case_.drag / def.mass);  // lost per second
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity(bt(def.velocity));
    body->setAngularVelocity(bt(def.omega));
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setFlags(flag);
    world_.addRigidBody(body.get(), 0, 0);
    bodies_.push_back(std::move(body));
  }

  void push() {
    for (const auto& body : bodies_) {
      body->applyTorque(bt(case_.torque_W));
      body->applyCentralForce(body->getCenterOfMassTransform().getBasis() * bt(case_.force_B));
    }
  }

  void pull() {
    for (const auto& body : bodies_)
      body->applyCentralForce((bt(case_.spring->anchor_W) - body->getCenterOfMassPosition()) *
                              case_.spring->stiffness);
  }

  const Case& case_;
  int steps_;
  double h_;  // [s]
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  btEmptyShape shape_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  for (const Mode& mode : kModes)
    for (const FixedStep& step : fixed_steps(c.bodies.size() == 1))
      result.push_back({mode.name + " " + step.name, [&c, flag = mode.flag, n = step.per_frame] {
                          return std::make_unique<Bullet>(c, flag, n);
                        }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure("bullet", poinsot::bench::settings, argc, argv);
}
