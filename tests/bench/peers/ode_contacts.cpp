// The contact scenes in ODE: the quick stepper, 20 iterations by default, and the direct one where
// the bodies are few. Contacts are rigid, their friction is the pyramid that the engine offers for
// Coulomb's law; hulls are its convex geometry.

#include <array>
#include <ode/ode.h>

#include "contact_measure.h"

namespace poinsot::bench {
namespace {

struct Mode {
  std::string name;
  int (*step)(dWorldID, dReal);
  int iterations;
};
const std::array<Mode, 3> kModes = {{{"quick-x20", dWorldQuickStep, 20},
                                     {"quick-x50", dWorldQuickStep, 50},
                                     {"step", dWorldStep, 20}}};

// The arrays that ODE's convex geometry refers to.
struct Hull {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;

  explicit Hull(const Convex& convex) {
    for (const Vec3& v : convex.vertices) points.insert(points.end(), {v.x(), v.y(), v.z()});
    for (const Convex::Face& face : convex.faces) {
      planes.insert(planes.end(), {face.normal.x(), face.normal.y(), face.normal.z(), face.offset});
      polygons.push_back(static_cast<unsigned>(face.loop.size()));
      for (const int index : face.loop) polygons.push_back(static_cast<unsigned>(index));
    }
  }
};

class Ode final : public ContactWorld {
 public:
  Ode(const ContactScene& c, const Mode& mode, int steps)
      : mode_(mode), steps_(steps), h_(1 / (kFrameRate * steps)), friction_(c.friction) {
    dWorldSetGravity(world_, 0, 0, -kGravity);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetQuickStepNumIterations(world_, mode.iterations);
    const Vec3 up = c.ground * Vec3::UnitZ();
    dCreatePlane(space_, up.x(), up.y(), up.z(), 0);
    for (const ContactBody& body : c.bodies) add(body);
    for (const ContactBody& wall : c.walls) place(geometry(wall.shape), wall.pose);
  }

  ~Ode() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) {
      dSpaceCollide(space_, this, &Ode::meet);
      mode_.step(world_, h_);
      dJointGroupEmpty(contacts_);
    }
  }

  void read(std::vector<ContactState>& states) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const dReal* c = dBodyGetPosition(bodies_[i]);
      const dReal* q = dBodyGetQuaternion(bodies_[i]);  // w x y z
      const dReal* v = dBodyGetLinearVel(bodies_[i]);
      const dReal* w = dBodyGetAngularVel(bodies_[i]);
      states[i] = {{Vec3(c[0], c[1], c[2]), Quat(q[0], q[1], q[2], q[3])},
                   Vec3(v[0], v[1], v[2]),
                   Vec3(w[0], w[1], w[2])};
    }
  }

 private:
  static void meet(void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->touch(a, b); }

  void touch(dGeomID a, dGeomID b) {
    constexpr int kMost = 8;
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (!body_a && !body_b) return;
    std::array<dContact, kMost> contacts{};
    const int n = dCollide(a, b, kMost, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = friction_;
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), body_a, body_b);
    }
  }

  dGeomID geometry(const Shape& shape) {
    if (const auto* box = std::get_if<Box>(&shape))
      return dCreateBox(space_, box->size.x(), box->size.y(), box->size.z());
    if (const auto* sphere = std::get_if<Sphere>(&shape))
      return dCreateSphere(space_, sphere->radius);
    if (const auto* capsule = std::get_if<Capsule>(&shape))
      return dCreateCapsule(space_, capsule->radius, capsule->length);
    const auto& convex = std::get<Convex>(shape);
    hulls_.push_back(std::make_unique<Hull>(convex));
    Hull& hull = *hulls_.back();
    return dCreateConvex(space_, hull.planes.data(), static_cast<unsigned>(convex.faces.size()),
                         hull.points.data(), static_cast<unsigned>(convex.vertices.size()),
                         hull.polygons.data());
  }

  static void place(dGeomID geometry, const Pose& pose) {
    const dQuaternion q = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()};
    dGeomSetPosition(geometry, pose.c.x(), pose.c.y(), pose.c.z());
    dGeomSetQuaternion(geometry, q);
  }

  void add(const ContactBody& def) {
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, def.mass, 0, 0, 0, def.moments.x(), def.moments.y(), def.moments.z(),
                       0, 0, 0);
    dBodySetMass(body, &mass);
    const dGeomID shape = geometry(def.shape);
    dGeomSetBody(shape, body);
    place(shape, def.pose);
    dBodySetLinearVel(body, def.velocity.x(), def.velocity.y(), def.velocity.z());
    bodies_.push_back(body);
  }

  const Mode& mode_;
  int steps_;
  double h_;  // [s]
  double friction_;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dHashSpaceCreate(nullptr);
  dJointGroupID contacts_ = dJointGroupCreate(0);
  std::vector<dBodyID> bodies_;
  std::vector<std::unique_ptr<Hull>> hulls_;
};

std::vector<ContactSetting> settings(const ContactCase& c) {
  std::vector<ContactSetting> result;
  const bool piles = c.question == Question::piles;
  for (const Mode& mode : kModes) {
    if (piles && mode.step == dWorldStep) continue;
    for (const int steps : {1, 4, 17}) {
      if (piles && steps * mode.iterations > 80) continue;
      result.push_back({mode.name + " 1/" + std::to_string(60 * steps),
                        [&mode, steps](const ContactScene& scene) {
                          return std::make_unique<Ode>(scene, mode, steps);
                        }});
    }
  }
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return poinsot::bench::measure_contacts("ode", poinsot::bench::settings, argc, argv);
}
