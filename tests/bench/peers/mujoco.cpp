// The cases in MuJoCo: its three integrators. A body has a free joint; where there is drag or a
// spring it has three slides and a ball instead, with damping and stiffness of the slides. Both
// have the same seven coordinates c, q (w x y z) and six velocities.

#include <cstring>
#include <mujoco/mujoco.h>
#include <sstream>
#include <stdexcept>

#include "measure.h"

namespace poinsot::bench {
namespace {

std::string numbers(const Eigen::VectorXd& values) {
  std::ostringstream text;
  text.precision(17);
  for (const double value : values) text << value << ' ';
  return text.str();
}

std::string joints(const Case& c) {
  if (c.drag == 0 && !c.spring) return "<freejoint/>";
  const double stiffness = c.spring ? c.spring->stiffness : 0;
  std::string text;
  for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"})
    text += "<joint type='slide' axis='" + std::string(axis) + "' damping='" +
            numbers(Eigen::VectorXd::Constant(1, c.drag)) + "' stiffness='" +
            numbers(Eigen::VectorXd::Constant(1, stiffness)) + "'/>";
  return text + "<joint type='ball'/>";
}

std::string model_text(const Case& c, const std::string& integrator, double h) {
  std::string text = "<mujoco><option timestep='" + numbers(Eigen::VectorXd::Constant(1, h)) +
                     "' integrator='" + integrator + "' gravity='" + numbers(c.gravity) +
                     "'><flag contact='disable' constraint='disable'/></option><worldbody>";
  for (const CaseBody& body : c.bodies)
    text += "<body>" + joints(c) + "<inertial pos='0 0 0' mass='" +
            numbers(Eigen::VectorXd::Constant(1, body.mass)) + "' diaginertia='" +
            numbers(body.moments) + "'/></body>";
  return text + "</worldbody></mujoco>";
}

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

class MuJoCo final : public Simulation {
 public:
  MuJoCo(const Case& c, const std::string& integrator, int steps)
      : case_(c),
        steps_(steps),
        anchor_(c.spring ? c.spring->anchor_W : Vec3(Vec3::Zero())),
        model_(load(model_text(c, integrator, 1 / (c.frame_rate * steps))), mj_deleteModel),
        data_(mj_makeData(model_.get()), mj_deleteData) {
    for (std::size_t i = 0; i < c.bodies.size(); ++i) place(c.bodies[i], i);
  }

  void advance_to(double) override {
    for (int i = 0; i < steps_; ++i) {
      if (case_.has_wrench()) push();
      mj_step(model_.get(), data_.get());
    }
  }

  void read(std::vector<Pose>& poses) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const mjtNum* x = data_->qpos + 7 * i;
      poses[i] = {anchor_ + Vec3(x[0], x[1], x[2]), orientation(i)};
    }
  }

 private:
  Quat orientation(std::size_t i) const {
    const mjtNum* x = data_->qpos + 7 * i;
    return {x[3], x[4], x[5], x[6]};
  }

  void place(const CaseBody& body, std::size_t i) {
    const Quat& q = body.pose.q;
    Eigen::Map<Vec3>(data_->qpos + 7 * i) = body.pose.c - anchor_;
    Eigen::Map<Eigen::Vector4d>(data_->qpos + 7 * i + 3) << q.w(), q.x(), q.y(), q.z();
    Eigen::Map<Vec3>(data_->qvel + 6 * i) = body.velocity;
    Eigen::Map<Vec3>(data_->qvel + 6 * i + 3) = q.conjugate() * body.omega;  // in B
  }

  void push() {
    for (std::size_t i = 0; i < case_.bodies.size(); ++i) {
      Eigen::Map<Eigen::Matrix<double, 6, 1>> wrench(data_->xfrc_applied + 6 * (i + 1));
      wrench << orientation(i) * case_.force_B, case_.torque_W;  // body 0 is the world
    }
  }

  const Case& case_;
  int steps_;
  Vec3 anchor_;  // [m] origin of the slides
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  // The implicit one keeps a dense matrix of all velocities: not with many bodies.
  std::vector<std::string> integrators = {"Euler", "RK4"};
  if (c.bodies.size() == 1) integrators.push_back("implicit");
  for (const std::string& integrator : integrators)
    for (const FixedStep& step : fixed_steps(c.bodies.size() == 1))
      result.push_back({integrator + " " + step.name, [&c, integrator, n = step.per_frame] {
                          return std::make_unique<MuJoCo>(c, integrator, n);
                        }});
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  mju_user_error = poinsot::bench::fail;
  return poinsot::bench::measure("mujoco", poinsot::bench::settings, argc, argv);
}
