// The contact scenes in Bullet (double precision): sequential impulses, 10 iterations by default.
// Friction is isotropic and a product of the bodies'. The margin of hulls lies outside of them, so
// it is small.

#include <btBulletDynamicsCommon.h>
#include <cmath>

#include "contact_measure.h"

namespace poinsot::bench {
namespace {

constexpr double kHullMargin = 1e-3;  // [m]

btVector3 bt(const Vec3& a) {
  return {a.x(), a.y(), a.z()};
}
Vec3 from(const btVector3& a) {
  return {a.x(), a.y(), a.z()};
}
btTransform bt(const Pose& pose) {
  return btTransform(btQuaternion(pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()), bt(pose.c));
}

std::unique_ptr<btCollisionShape> shape_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape))
    return std::make_unique<btBoxShape>(bt(0.5 * box->size));
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return std::make_unique<btSphereShape>(sphere->radius);
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return std::make_unique<btCapsuleShapeZ>(capsule->radius, capsule->length);
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& vertex : std::get<Convex>(shape).vertices) hull->addPoint(bt(vertex), false);
  hull->recalcLocalAabb();
  hull->setMargin(kHullMargin);
  return hull;
}

struct Way {
  int iterations, steps;
  bool two_directions = false;  // of friction, across each other; by default it has the slip's

  std::string name() const {
    return std::string(two_directions ? "SI-2-x" : "SI-x") + std::to_string(iterations) + " 1/" +
           std::to_string(60 * steps);
  }
};

class Bullet final : public ContactWorld {
 public:
  Bullet(const ContactScene& c, const Way& way)
      : steps_(way.steps), h_(1 / (kFrameRate * steps_)), friction_(std::sqrt(c.friction)) {
    world_.setGravity({0, 0, -kGravity});
    world_.getSolverInfo().m_numIterations = way.iterations;
    if (way.two_directions) world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    for (const ContactBody& body : c.bodies) add(body);
    moving_ = bodies_.size();
    for (const ContactBody& wall : c.walls) add(wall);
    add({}, std::make_unique<btStaticPlaneShape>(bt(c.ground * Vec3::UnitZ()), 0));
  }

  ~Bullet() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) world_.stepSimulation(h_, 0);
  }

  void read(std::vector<ContactState>& states) const override {
    for (std::size_t i = 0; i < moving_; ++i) {
      const btRigidBody& body = *bodies_[i];
      const btQuaternion q = body.getOrientation();
      states[i] = {{from(body.getCenterOfMassPosition()), Quat(q.w(), q.x(), q.y(), q.z())},
                   from(body.getLinearVelocity()),
                   from(body.getAngularVelocity())};
    }
  }

 private:
  void add(const ContactBody& def) { add(def, shape_of(def.shape)); }

  void add(const ContactBody& def, std::unique_ptr<btCollisionShape> shape) {
    btRigidBody::btRigidBodyConstructionInfo info(def.mass, nullptr, shape.get(), bt(def.moments));
    info.m_startWorldTransform = bt(def.pose);
    info.m_friction = friction_;
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity(bt(def.velocity));
    body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
    shapes_.push_back(std::move(shape));
  }

  int steps_;
  double h_;  // [s]
  double friction_;
  std::size_t moving_ = 0;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

std::vector<ContactSetting> settings(const ContactCase& c) {
  std::vector<Way> ways = {{10, 1}, {10, 4}, {50, 1}};
  if (c.question != Question::piles)
    ways.insert(
        ways.end(),
        {{10, 17}, {50, 4}, {50, 17}, {200, 4}, {10, 1, true}, {10, 4, true}, {50, 17, true}});
  std::vector<ContactSetting> result;
  for (const Way& way : ways)
    result.push_back({way.name(), [way](const ContactScene& scene) {
                        return std::make_unique<Bullet>(scene, way);
                      }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure_contacts("bullet", poinsot::bench::settings, argc, argv);
}
