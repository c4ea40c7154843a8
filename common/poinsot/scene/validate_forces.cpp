#include "poinsot/scene/validate_forces.h"

#include <string>
#include <string_view>
#include <utility>

#include "poinsot/base/limits.h"
#include "poinsot/scene/body_names.h"
#include "poinsot/scene/fault_text.h"

namespace poinsot {
namespace {

// Points nearer to each other than this, relative to how far they are from the origins that they
// are given from, coincide: the direction between them is one of rounding.
constexpr double kCoincidence = 1e-12;

constexpr double kMaxDuration = 1e-9 * static_cast<double>(kMaxDurationNs);  // [s]

class ForceValidation {
 public:
  explicit ForceValidation(const Scene& scene) : scene_(scene), bodies_(scene) {}

  std::vector<SceneFault> run() {
    check_count("springs", scene_.springs.size(), kMaxSprings);
    for (std::size_t i = 0; i < scene_.springs.size(); ++i) {
      const SpringDef& spring = scene_.springs[i];
      where_ = &spring.where;
      path_ = "springs[" + std::to_string(i) + "]";
      check(spring);
    }
    where_ = &kNowhere;
    path_.clear();
    check_count("wrenches", scene_.wrenches.size(), kMaxHeldWrenches);
    for (std::size_t i = 0; i < scene_.wrenches.size(); ++i) {
      const WrenchDef& wrench = scene_.wrenches[i];
      where_ = &wrench.where;
      path_ = "wrenches[" + std::to_string(i) + "]";
      check(wrench);
    }
    return std::move(faults_);
  }

 private:
  // A fault of the entry's value at `key`; without one, of the entry.
  void add(std::string_view key, std::string what) {
    if (what.empty()) return;
    std::string path = path_;
    if (!key.empty()) path.append(path.empty() ? "" : ".").append(key);
    faults_.push_back({*where_, std::move(what), std::move(path)});
  }

  void check_count(std::string_view key, std::size_t count, std::size_t limit) {
    if (count > limit)
      add(key, "a scene has at most " + std::to_string(limit) + " " + std::string(key) +
                   ", this one " + std::to_string(count));
  }

  void check_vector(std::string_view key, const Vec3& v, double limit, std::string_view unit) {
    if (!is_within(v, limit))
      add(key, std::string(key) + " must be finite and at most " + digits(limit) + " " +
                   std::string(unit));
  }

  // The body of that name; a fault and nothing if there is none.
  const BodyDef* find(std::string_view key, const std::string& name) {
    const BodyDef* body = bodies_.find(name);
    if (!body) add(key, bodies_.unknown(name));
    return body;
  }

  // Springs ---------------------------------------------------------------------------------------

  void check(const SpringDef& spring) {
    const BodyDef* a = find("a", spring.a);
    const BodyDef* b = spring.b.empty() ? nullptr : find("b", spring.b);
    check_vector("point_a", spring.point_a, kMaxPoint, "m");
    check_vector("point_b", spring.point_b, kMaxPoint, "m");
    add("stiffness", coefficient_fault("stiffness", spring.stiffness, "N/m"));
    add("damping", coefficient_fault("damping", spring.damping, "N·s/m"));
    if (spring.stiffness == 0 && spring.damping == 0)
      add("", "a spring needs a stiffness or a damping > 0");
    if (spring.rest_length)
      add("rest_length", coefficient_fault("rest_length", *spring.rest_length, "m"));
    if (!a || (!b && !spring.b.empty())) return;
    for (const auto& [key, body] : {std::pair{"a", a}, {"b", b}})
      if (body && body->is_kinematic)
        add(key, "a spring to a kinematic body is not supported yet, " + in_quotes(body->name) +
                     " is one");
    if (a == b)
      add("b", "a spring must have its ends on two bodies, both are on " + in_quotes(spring.a));
    else if (a->is_static && (!b || b->is_static))
      add("", "a spring needs an end on a body that moves");
    else
      check_direction(spring, *a, b);
  }

  // The force acts along the line between the points: there must be one at time 0, unless the force
  // is the same without it, stiffness times the vector between them.
  void check_direction(const SpringDef& spring, const BodyDef& a, const BodyDef* b) {
    const Vec3 arm_a = a.pose.q * spring.point_a;
    const Vec3 arm_b = b ? Vec3(b->pose.q * spring.point_b) : spring.point_b;
    const Vec3 origin_b = b ? b->pose.c : Vec3::Zero();
    const double scale = a.pose.c.norm() + arm_a.norm() + origin_b.norm() + arm_b.norm();
    const double distance = (origin_b + arm_b - a.pose.c - arm_a).norm();
    const bool needs_one = spring.damping > 0 || spring.rest_length.value_or(0) > 0;
    if (needs_one && distance <= kCoincidence * scale)
      add("",
          "the ends of a spring with a rest_length or a damping must not coincide at time 0: the "
          "direction of its force would be undefined");
  }

  // Wrenches --------------------------------------------------------------------------------------

  void check(const WrenchDef& wrench) {
    const BodyDef* body = find("body", wrench.body);
    if (body && (body->is_static || body->is_kinematic))
      add("body", "a wrench acts on a body that forces move, " + in_quotes(wrench.body) + " is " +
                      (body->is_static ? "static" : "kinematic"));
    check_vector("force", wrench.force, kMaxWrench, "N");
    check_vector("torque", wrench.torque, kMaxWrench, "N·m");
    if (wrench.axes > Axes::body) add("frame", "frame must be world or body");
    if (wrench.point_frame > PointFrame::body)
      add("point_frame", "point_frame must be center_of_mass, world or body");
    if (wrench.point_frame != PointFrame::center_of_mass)
      check_vector("point", wrench.point, kMaxPoint, "m");
    if (!(wrench.start >= 0 && wrench.start <= kMaxDuration))
      add("start", "start must be 0 to " + digits(kMaxDuration) + " s, is " + digits(wrench.start));
    else if (wrench.start > 0 && wrench.point_frame == PointFrame::world)
      add("point_frame",
          "a point in the world becomes fixed to the body at time 0: with a start > 0 it must be "
          "given in the body");
    if (wrench.duration && !(*wrench.duration > 0 && *wrench.duration <= kMaxDuration))
      add("duration", "duration must be > 0 s and at most " + digits(kMaxDuration) + " s, is " +
                          digits(*wrench.duration));
  }

  inline static const std::string kNowhere;

  const Scene& scene_;
  BodyNames bodies_;
  const std::string* where_ = &kNowhere;  // of the entry that is looked at
  std::string path_;
  std::vector<SceneFault> faults_;
};

}  // namespace

std::vector<SceneFault> validate_forces(const Scene& scene) {
  return ForceValidation(scene).run();
}

}  // namespace poinsot
