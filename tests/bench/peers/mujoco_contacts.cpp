// The contact scenes in MuJoCo: Newton's solver and pyramidal cones, as by default; elliptic cones;
// contacts as stiff as the step allows; conjugate gradients where Newton's matrices do not fit.
// Contacts are soft by design. Friction of a pair is the larger of the two.

#include <cstring>
#include <limits>
#include <mujoco/mujoco.h>
#include <sstream>
#include <stdexcept>

#include "contact_measure.h"

namespace poinsot::bench {
namespace {

struct Way {
  std::string solver, cone;
  int steps;
  bool stiff = false;

  std::string name() const {
    return solver + (cone == "elliptic" ? "-elliptic" : "") + (stiff ? "-stiff" : "") + " 1/" +
           std::to_string(60 * steps);
  }
};

template <class... Values>
std::string numbers(const Values&... values) {
  std::ostringstream text;
  text.precision(17);
  ((text << values << ' '), ...);
  return text.str();
}
std::string numbers3(const Vec3& a) {
  return numbers(a.x(), a.y(), a.z());
}
std::string pose_text(const Pose& pose) {
  return "pos='" + numbers3(pose.c) + "' quat='" +
         numbers(pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()) + "'";
}

// Meshes are centred and turned to principal axes by the compiler, which is where they are.
class ModelText {
 public:
  ModelText(const ContactScene& c, const Way& way) : friction_(numbers(c.friction, 0, 0)) {
    if (way.stiff) solref_ = " solref='" + numbers(2 / (kFrameRate * way.steps), 1) + "'";
    text_ = "<geom type='plane' size='0 0 1' " + pose_text({Vec3::Zero(), c.ground}) + surface();
    for (const ContactBody& body : c.bodies) add(body);
    for (const ContactBody& wall : c.walls) text_ += "<geom " + pose_text(wall.pose) + geom(wall);
    text_ = "<mujoco><option timestep='" + numbers(1 / (kFrameRate * way.steps)) + "' solver='" +
            way.solver + "' cone='" + way.cone + "' gravity='0 0 " + numbers(-kGravity) +
            "'/><size " + room(c.bodies.size()) + "/><asset>" + assets_ + "</asset><worldbody>" +
            text_ + "</worldbody></mujoco>";
  }
  const std::string& text() const { return text_; }

 private:
  // Eight contacts a body where bodies are few, else four, of four rows each: all rows by all rows
  // are a matrix, and the engine counts its bytes in 31 bits.
  static std::string room(std::size_t bodies) {
    const std::size_t contacts = (bodies > 100 ? 4 : 8) * bodies + 100;
    return "nconmax='" + std::to_string(contacts) + "' njmax='" + std::to_string(4 * contacts) +
           "'";
  }

  std::string surface() const {
    return " condim='3' friction='" + friction_ + "'" + solref_ + "/>";
  }

  std::string geom(const ContactBody& body) {
    if (const auto* box = std::get_if<Box>(&body.shape))
      return "type='box' size='" + numbers3(0.5 * box->size) + "'" + surface();
    if (const auto* sphere = std::get_if<Sphere>(&body.shape))
      return "type='sphere' size='" + numbers(sphere->radius) + "'" + surface();
    if (const auto* capsule = std::get_if<Capsule>(&body.shape))
      return "type='capsule' size='" + numbers(capsule->radius, 0.5 * capsule->length) + "'" +
             surface();
    const std::string name = "hull_" + std::to_string(hulls_++);
    assets_ += "<mesh name='" + name + "' vertex='";
    for (const Vec3& vertex : std::get<Convex>(body.shape).vertices) assets_ += numbers3(vertex);
    assets_ += "'/>";
    return "type='mesh' mesh='" + name + "'" + surface();
  }

  void add(const ContactBody& body) {
    text_ += "<body " + pose_text(body.pose) + "><freejoint/><inertial pos='0 0 0' mass='" +
             numbers(body.mass) + "' diaginertia='" + numbers3(body.moments) + "'/><geom " +
             geom(body) + "</body>";
  }

  std::string friction_, solref_, text_, assets_;
  int hulls_ = 0;
};

mjModel* load(const std::string& text) {
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "case.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char fault[1000] = "";
  mjModel* model = mj_loadXML("case.xml", files.get(), fault, sizeof(fault));
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(fault);
  return model;
}

// The engine's errors end the process unless they leave its handler otherwise.
[[noreturn]] void fail(const char* text) {
  throw std::runtime_error(text);
}

class MuJoCo final : public ContactWorld {
 public:
  MuJoCo(const ContactScene& c, const Way& way)
      : steps_(way.steps),
        model_(load(ModelText(c, way).text()), mj_deleteModel),
        data_(mj_makeData(model_.get()), mj_deleteData) {
    for (std::size_t i = 0; i < c.bodies.size(); ++i)
      Eigen::Map<Vec3>(data_->qvel + 6 * i) = c.bodies[i].velocity;
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) mj_step(model_.get(), data_.get());
    for (const int warning :
         {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[warning].number > 0)
        throw std::runtime_error(mju_warningText(warning, data_->warning[warning].lastinfo));
  }

  void read(std::vector<ContactState>& states) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const mjtNum* x = data_->qpos + 7 * i;
      const mjtNum* v = data_->qvel + 6 * i;
      const Quat q(x[3], x[4], x[5], x[6]);
      states[i] = {{Vec3(x[0], x[1], x[2]), q}, Vec3(v[0], v[1], v[2]), q * Vec3(v[3], v[4], v[5])};
    }
  }

 private:
  int steps_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

std::vector<ContactSetting> settings(const ContactCase& c) {
  std::vector<Way> ways = {{"Newton", "pyramidal", 1},       {"Newton", "pyramidal", 4},
                           {"Newton", "pyramidal", 17},      {"Newton", "elliptic", 4},
                           {"Newton", "elliptic", 17},       {"Newton", "pyramidal", 1, true},
                           {"Newton", "pyramidal", 4, true}, {"Newton", "pyramidal", 17, true},
                           {"Newton", "elliptic", 17, true}};
  if (c.question == Question::piles) ways = {{"Newton", "pyramidal", 1}, {"CG", "pyramidal", 1}};
  std::vector<ContactSetting> result;
  for (const Way& way : ways)
    result.push_back({way.name(), [way](const ContactScene& scene) {
                        return std::make_unique<MuJoCo>(scene, way);
                      }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  mju_user_error = poinsot::bench::fail;
  return poinsot::bench::measure_contacts("mujoco", poinsot::bench::settings, argc, argv);
}
