#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"
#include "poinsot/base/utf8.h"
#include "poinsot/math/inertia.h"
#include "poinsot/scene/fault_text.h"
#include "poinsot/scene/scene.h"
#include "poinsot/scene/validate_forces.h"
#include "poinsot/scene/validate_pairs.h"

namespace poinsot {
namespace {

constexpr double kUnitSlack = 1e-9;  // [-] how far from 1 the norm of a unit quantity may be
constexpr double kMinFrameRate = 1e-3, kMaxFrameRate = 1e6;  // [Hz]
constexpr double kMinStep = 1e-9, kMaxStep = 1;              // [s]
constexpr double kMinTolerance = 1e-15, kMaxTolerance = 1e-1;
constexpr double kMaxStepsPerFrame = 1e6;
// A band below the rounding of positions of the body's size is never entered; above a thousandth
// bodies would visibly float.
constexpr double kMinBand = 1e-13, kMaxBand = 1e-3;
constexpr double kLeastMass = 1e-30, kMostMass = 1e30;  // [kg] squares and inverses stay finite
constexpr int kMaxImpacts = 1'000'000;                  // of a frame and island
constexpr int kMaxThreads = 256;

bool sane(const Vec3& v) {
  return is_within(v, kMagnitude);
}

bool is_unit(double norm) {
  return std::abs(norm - 1) <= kUnitSlack;
}

std::string name_fault(std::string_view name) {
  if (name.empty()) return "a body's name must not be empty";
  if (name.size() > kMaxNameLength)
    return "a body's name must have at most " + std::to_string(kMaxNameLength) + " bytes, has " +
           std::to_string(name.size());
  if (!is_printable_utf8(name)) return "a body's name must be printable UTF-8 text";
  return {};
}

std::string world_fault(std::string_view world) {
  const bool good =
      !world.empty() && world.size() <= kMaxNameLength && std::ranges::all_of(world, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
      });
  return good ? std::string()
              : "world must be 1 to " + std::to_string(kMaxNameLength) +
                    " letters, digits, '_' or '-', is " + in_quotes(world);
}

// Sizes ------------------------------------------------------------------------------------------

std::string size_fault(std::string_view what, double value) {
  if (value > 0 && value <= kMagnitude) return {};
  return std::string(what) + " must be > 0 m and at most " + digits(kMagnitude) + " m, is " +
         digits(value);
}

std::string sizes_fault(std::string_view what, const Vec3& sizes) {
  for (int i = 0; i < 3; ++i)
    if (auto fault = size_fault(std::string(what).append({' ', "xyz"[i]}), sizes[i]);
        !fault.empty())
      return fault;
  return {};
}

template <class Round>
std::string round_fault(std::string_view kind, const Round& s) {
  auto fault = size_fault(std::string(kind) + " radius", s.radius);
  return fault.empty() ? size_fault(std::string(kind) + " length", s.length) : fault;
}

struct ShapeFault {
  std::string operator()(const Sphere& s) const { return size_fault("sphere radius", s.radius); }
  std::string operator()(const Box& s) const { return sizes_fault("box size", s.size); }
  std::string operator()(const Capsule& s) const { return round_fault("capsule", s); }
  std::string operator()(const Cylinder& s) const { return round_fault("cylinder", s); }
  std::string operator()(const Cone& s) const { return round_fault("cone", s); }
  std::string operator()(const Ellipsoid& s) const {
    return sizes_fault("ellipsoid semi-axis", s.semi_axes);
  }
  std::string operator()(const Convex& s) const {
    if (s.vertices.size() < 4 || s.faces.size() < 4)
      return "convex must be made by convex_hull(): it has " + std::to_string(s.vertices.size()) +
             " vertices and " + std::to_string(s.faces.size()) + " faces";
    if (!std::ranges::all_of(s.vertices, sane))
      return "convex points must be finite and at most " + digits(kMagnitude) + " m from 0";
    const int count = static_cast<int>(s.vertices.size());
    for (const Convex::Face& face : s.faces)
      for (int i : face.loop)
        if (i < 0 || i >= count) return "convex face names vertex " + std::to_string(i);
    return {};
  }
  std::string operator()(const HalfSpace& s) const {
    if (!s.normal.allFinite() || !is_unit(s.normal.norm()))
      return "half_space normal must have length 1";
    if (!(std::abs(s.offset) <= kMagnitude))
      return "half_space offset must be finite and at most " + digits(kMagnitude) + " m, is " +
             digits(s.offset);
    return {};
  }
  std::string operator()(const Mesh& s) const {
    if (s.triangles.empty()) return "mesh must be made by make_mesh(): it has no triangles";
    if (s.triangles.size() > kMaxTriangles || s.vertices.size() > kMaxMeshVertices)
      return "mesh has more than " + std::to_string(kMaxTriangles) + " triangles or " +
             std::to_string(kMaxMeshVertices) + " vertices";
    if (!std::ranges::all_of(s.vertices, sane))
      return "mesh vertices must be finite and at most " + digits(kMagnitude) + " m from 0";
    const int count = static_cast<int>(s.vertices.size());
    for (const auto& triangle : s.triangles)
      for (const int i : triangle)
        if (i < 0 || i >= count) return "mesh triangle names vertex " + std::to_string(i);
    return {};
  }
};

// Masses -----------------------------------------------------------------------------------------

std::string inertia_fault(const Mat3& J) {
  if (!J.allFinite()) return "inertia must be finite";
  if (is_physical_inertia(J)) return {};
  if (!J.isApprox(J.transpose(), kUnitSlack)) return "inertia must be symmetric";
  const Vec3 p = principal_moments(J);
  return "no solid has this inertia: its principal moments are " + digits(p[0]) + ", " +
         digits(p[1]) + " and " + digits(p[2]) + " kg·m²; " +
         (p[0] > 0 ? "the greatest must not exceed the sum of the other two" : "all must be > 0");
}

// The walk over a scene --------------------------------------------------------------------------

class Validation {
 public:
  std::vector<SceneFault> run(const Scene& scene) {
    add("", "world", world_fault(scene.world));
    check_tables(scene);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      check_body(scene.bodies[i], "bodies[" + std::to_string(i) + "]");
    for (SceneFault& fault : validate_forces(scene)) faults_.push_back(std::move(fault));
    for (SceneFault& fault : validate_pairs(scene)) faults_.push_back(std::move(fault));
    return std::move(faults_);
  }

 private:
  void add(const std::string& where, const std::string& path, std::string what) {
    if (!what.empty()) faults_.push_back({where, std::move(what), path});
  }
  void require(bool good, const std::string& path, const std::string& what, double value) {
    if (!good) add("", path, what + ", is " + digits(value));
  }

  void check_tables(const Scene& scene) {
    check_steps(scene);
    check_collision(scene.collision);
    check_simulation(scene.simulation);
  }

  void check_steps(const Scene& scene) {
    const double rate = scene.presentation.frame_rate;
    require(rate >= kMinFrameRate && rate <= kMaxFrameRate, "presentation.frame_rate",
            "frame_rate must be " + digits(kMinFrameRate) + " to " + digits(kMaxFrameRate) + " Hz",
            rate);
    const CollisionDef& c = scene.collision;
    require(c.contact_step >= kMinStep && c.contact_step <= kMaxStep, "collision.contact_step",
            "contact_step must be " + digits(kMinStep) + " to " + digits(kMaxStep) + " s",
            c.contact_step);
    for (const double step : {c.contact_step, scene.simulation.step})
      if (step > 0 && rate > 0 && 1 / (rate * step) > kMaxStepsPerFrame)
        add("", "collision.contact_step",
            "a frame would take more than " + digits(kMaxStepsPerFrame) + " steps of " +
                digits(step) + " s");
  }

  void check_collision(const CollisionDef& c) {
    require(c.contact_tolerance > 0 && c.contact_tolerance < 1, "collision.contact_tolerance",
            "contact_tolerance must be > 0 and < 1", c.contact_tolerance);
    require(c.contact_margin >= 0 && c.contact_margin <= 1, "collision.contact_margin",
            "contact_margin must be 0 to 1", c.contact_margin);
    require(c.push_out_speed >= 0 && c.push_out_speed <= kMagnitude, "collision.push_out_speed",
            "push_out_speed must be >= 0 m/s and finite", c.push_out_speed);
    require(c.contact_band >= kMinBand && c.contact_band <= kMaxBand, "collision.contact_band",
            "contact_band must be " + digits(kMinBand) + " to " + digits(kMaxBand), c.contact_band);
    require(c.max_impacts >= 0 && c.max_impacts <= kMaxImpacts, "collision.max_impacts",
            "max_impacts must be 0 to " + std::to_string(kMaxImpacts), c.max_impacts);
    require(c.sleep_acceleration >= 0 && c.sleep_acceleration <= kMagnitude,
            "collision.sleep_acceleration", "sleep_acceleration must be >= 0 m/s² and finite",
            c.sleep_acceleration);
    require(c.threads >= 1 && c.threads <= kMaxThreads, "collision.threads",
            "threads must be 1 to " + std::to_string(kMaxThreads), c.threads);
  }

  void check_simulation(const SimulationDef& s) {
    require(s.step == 0 || (s.step >= kMinStep && s.step <= kMaxStep), "simulation.step",
            "step must be 0 (one per contact step) or " + digits(kMinStep) + " to " +
                digits(kMaxStep) + " s",
            s.step);
    require(s.tolerance == 0 || (s.tolerance >= kMinTolerance && s.tolerance <= kMaxTolerance),
            "simulation.tolerance",
            "tolerance must be 0 (the integrator's own) or " + digits(kMinTolerance) + " to " +
                digits(kMaxTolerance),
            s.tolerance);
    if (!sane(s.gravity))
      add("", "simulation.gravity",
          "gravity must be finite and at most " + digits(kMagnitude) + " m/s²");
  }

  void check_body(const BodyDef& body, const std::string& path) {
    if (body.generation == 0)
      add(body.where, path, "a body's generation must be > 0: 0 is that of no body");
    if (body.absent) {
      if (!body.shapes.empty()) add(body.where, path + ".shapes", "an absent body has no shape");
      return;
    }
    add(body.where, path + ".name", name_fault(body.name));
    const auto [first, is_new] = names_.emplace(body.name, body.where.empty() ? path : body.where);
    if (!is_new)
      add(body.where, path + ".name",
          "duplicate body name " + in_quotes(body.name) + ", first at " + first->second);
    check_vector(body, path + ".position", body.pose.c, "m");
    check_vector(body, path + ".linear_velocity", body.linear_velocity, "m/s");
    check_vector(body, path + ".angular_velocity", body.angular_velocity, "rad/s");
    check_quaternion(body, path + ".orientation", body.pose.q);
    check_material(body, path + ".material");
    check_drag(body, path + ".drag");
    for (std::size_t k = 0; k < body.shapes.size(); ++k)
      check_shape(body, body.shapes[k], path + ".shapes[" + std::to_string(k) + "]");
    if (body.shapes.size() > kMaxShapes)
      add(body.where, path + ".shapes",
          "a body has at most " + std::to_string(kMaxShapes) + " shapes, this one " +
              std::to_string(body.shapes.size()));
    if (body.is_static && body.is_kinematic)
      add(body.where, path + ".kinematic", "a body must be either static or kinematic");
    if (body.is_static)
      check_static(body, path);
    else if (body.is_kinematic)
      check_kinematic(body, path);
    else
      check_masses(body, path);
  }

  void check_masses(const BodyDef& body, const std::string& path) {
    const MassProperties& m = body.mass_properties;
    if (!(m.mass > 0) || !std::isfinite(m.mass))
      add(body.where, path + ".mass", "mass must be > 0 kg and finite, is " + digits(m.mass));
    else if (m.mass < kLeastMass || m.mass > kMostMass)
      add(body.where, path + ".mass",
          "mass must be " + digits(kLeastMass) + " to " + digits(kMostMass) + " kg, is " +
              digits(m.mass));
    check_vector(body, path + ".center_of_mass", m.center_of_mass, "m");
    if (m.mass > 0) add(body.where, path + ".inertia", inertia_fault(m.J));
  }

  void check_static(const BodyDef& body, const std::string& path) {
    if (body.mass_properties.mass != 0)
      add(body.where, path + ".mass", "a static body has no mass");
    if (!body.linear_velocity.isZero(0))
      add(body.where, path + ".linear_velocity", "a static body has no linear_velocity");
    if (!body.angular_velocity.isZero(0))
      add(body.where, path + ".angular_velocity", "a static body has no angular_velocity");
  }

  void check_kinematic(const BodyDef& body, const std::string& path) {
    if (body.mass_properties.mass != 0)
      add(body.where, path + ".mass", "a kinematic body has no mass");
  }

  void check_shape(const BodyDef& body, const ShapeDef& def, const std::string& path) {
    add(body.where, path + ".shape", shape_fault(def.shape));
    check_vector(body, path + ".position", def.pose.c, "m");
    check_quaternion(body, path + ".orientation", def.pose.q);
    if (!body.is_static && std::holds_alternative<HalfSpace>(def.shape))
      add(body.where, path + ".shape", "only a static body may have a half_space");
    if (!body.is_static && !body.is_kinematic && std::holds_alternative<Mesh>(def.shape))
      add(body.where, path + ".shape", "only a static or kinematic body may have a mesh");
  }

  void check_vector(const BodyDef& body, const std::string& path, const Vec3& v,
                    std::string_view unit) {
    if (sane(v)) return;
    add(body.where, path,
        path.substr(path.rfind('.') + 1) + " must be finite and at most " + digits(kMagnitude) +
            " " + std::string(unit));
  }

  void check_quaternion(const BodyDef& body, const std::string& path, const Quat& q) {
    if (!q.coeffs().allFinite() || !is_unit(q.norm()))
      add(body.where, path, "orientation must be a unit quaternion, has norm " + digits(q.norm()));
  }

  void check_material(const BodyDef& body, const std::string& path) {
    const Material& m = body.material;
    if (!(m.friction >= 0 && m.friction <= kMagnitude))
      add(body.where, path + ".friction",
          "friction must be >= 0 and finite, is " + digits(m.friction));
    if (!(m.restitution >= 0 && m.restitution <= 1))
      add(body.where, path + ".restitution",
          "restitution must be 0 to 1, is " + digits(m.restitution));
  }

  void check_drag(const BodyDef& body, const std::string& path) {
    const DragDef& d = body.drag;
    add(body.where, path + ".linear", coefficient_fault("linear drag", d.linear, "N·s/m"));
    add(body.where, path + ".quadratic",
        coefficient_fault("quadratic drag", d.quadratic, "N·s²/m²"));
    add(body.where, path + ".angular", coefficient_fault("angular drag", d.angular, "N·m·s/rad"));
    if ((body.is_static || body.is_kinematic) && (d.linear > 0 || d.quadratic > 0 || d.angular > 0))
      add(body.where, path,
          std::string("a ") + (body.is_static ? "static" : "kinematic") + " body has no drag");
  }

  std::vector<SceneFault> faults_;
  std::map<std::string, std::string> names_;  // → where it was first used
};

}  // namespace

std::string shape_fault(const Shape& shape) {
  return std::visit(ShapeFault(), shape);
}

CollisionDef collision_defaults(Profile profile) {
  CollisionDef def;
  if (profile == Profile::fast) def.contact_tolerance = 1e-3;
  return def;
}

std::vector<SceneFault> validate(const Scene& scene) {
  return Validation().run(scene);
}

void throw_faults(const std::vector<SceneFault>& faults) {
  std::string text;
  for (const SceneFault& fault : faults) {
    const std::string& where = fault.where.empty() ? fault.path : fault.where;
    if (!text.empty()) text += '\n';
    if (!where.empty()) text.append(where).append(": ");
    text += fault.what;
  }
  throw Error(text);
}

}  // namespace poinsot
