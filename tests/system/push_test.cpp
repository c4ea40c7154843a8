// A push from the command line, seen by another process: Δv = F t / m in exactly the frames that
// the reply names, and turning bodies against an integration of Euler's equations that shares no
// code.

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kFrameRate = 60;          // [Hz]
constexpr double kStep = 1.0 / 240;        // [s] of the daemon's integrator
constexpr double kMass = 2;                // [kg]
const Vector3d kInertia(0.3, 0.5, 0.7);    // [kg m²] principal, body axes
const Quaterniond kStart(0.8, 0, 0.6, 0);  // B → W
constexpr double kPushTolerance = 1e-12;   // relative: what is promised of Δv

// Free bodies, far from each other; nothing but pushes moves them.
constexpr const char* kScene = R"(world: free
simulation: {integrator: rk4, gravity: [0, 0, 0]}
bodies:
  - name: probe
    mass: 2
    inertia: {ixx: 0.3, iyy: 0.5, izz: 0.7}
    orientation: {x: 0, y: 0.6, z: 0, w: 0.8}
  - {name: bystander, shape: {sphere: 0.1}, mass: 1, position: [50, 0, 0]}
)";

Vector3d vector(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

std::string text(const Vector3d& v) {
  const std::string list = Json{v.x(), v.y(), v.z()}.dump();  // [x,y,z]
  return list.substr(1, list.size() - 2);
}

struct Seen {
  std::uint64_t frame = 0;
  Quaterniond q;
  Vector3d v, omega;  // in W
};

Seen probe(const Json& frame) {
  const Json& body = frame["bodies"].at(0);
  const Json& q = body["orientation"];
  return {frame["frame"], Quaterniond(q["w"], q["x"], q["y"], q["z"]),
          vector(body["linear_velocity"]), vector(body["angular_velocity"])};
}

// A push while the run goes on, and the probe in every frame from before it until after it.
struct Push {
  std::uint64_t first = 0, last = 0;
  std::vector<Seen> frames;

  explicit Push(const Words& options) {
    const TemporaryFile scene("free.yaml", kScene);
    const Daemon daemon(scene.path());
    Watcher watcher({"--body", "probe"});
    frames.push_back(probe(watcher.next()));
    Words arguments = {"push", "probe"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Json reply = client_json(arguments);
    first = reply["first_frame"];
    last = reply["last_frame"];
    while (frames.back().frame < last + 10) frames.push_back(probe(watcher.next()));
  }

  double seconds_at(std::uint64_t frame) const {
    if (frame < first) return 0;
    return static_cast<double>(std::min(frame, last) - first + 1) / kFrameRate;
  }
};

// The probe, driven by a force at a body-fixed point for `seconds`: classical RK4 on (q, ω_B, v)
// with steps so short that rounding is what is left.
struct Reference {
  Quaterniond q = kStart;
  Vector3d omega_B = Vector3d::Zero(), v = Vector3d::Zero();

  using State = Eigen::Matrix<double, 10, 1>;

  static State rate(const State& y, const Vector3d& force, bool body_axes, const Vector3d& arm_B) {
    const Quaterniond q = Quaterniond(y[0], y[1], y[2], y[3]).normalized();
    const Vector3d w = y.segment<3>(4);
    const Vector3d force_B = body_axes ? force : q.conjugate() * force;
    const Vector3d torque_B = arm_B.cross(force_B);
    const Quaterniond dq = q * Quaterniond(0, w.x() / 2, w.y() / 2, w.z() / 2);
    State dy;
    dy << dq.w(), dq.x(), dq.y(), dq.z(),
        (torque_B - w.cross(kInertia.cwiseProduct(w))).cwiseQuotient(kInertia), q * force_B / kMass;
    return dy;
  }

  void advance(double seconds, const Vector3d& force, bool body_axes, const Vector3d& arm_B) {
    const int steps = static_cast<int>(std::lround(seconds * kFrameRate)) * 200;
    const double h = seconds / steps;
    State y;
    y << q.w(), q.x(), q.y(), q.z(), omega_B, v;
    const auto f = [&](const State& at) { return rate(at, force, body_axes, arm_B); };
    for (int i = 0; i < steps; ++i) {
      const State k1 = f(y), k2 = f(y + h / 2 * k1), k3 = f(y + h / 2 * k2), k4 = f(y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    q = Quaterniond(y[0], y[1], y[2], y[3]).normalized();
    omega_B = y.segment<3>(4);
    v = y.tail<3>();
  }
};

void expect_velocity_of_a_world_force(const Push& push, const Vector3d& force) {
  for (const Seen& seen : push.frames) {
    const Vector3d expected = force * push.seconds_at(seen.frame) / kMass;
    EXPECT_LE((seen.v - expected).norm(), kPushTolerance * expected.norm()) << seen.frame;
  }
}

// Within the order of RK4: an error of (λ h)⁴, where a body that starts at rest turns at the rates
// that its angular acceleration gives: λ = √(|arm| |force| / J_min).
void expect_reference(const Push& push, const Vector3d& force, bool body_axes,
                      const Vector3d& arm_B) {
  const Seen& end = *std::find_if(push.frames.begin(), push.frames.end(),
                                  [&](const Seen& seen) { return seen.frame == push.last; });
  Reference reference;
  reference.advance(push.seconds_at(push.last), force, body_axes, arm_B);
  const Vector3d omega = reference.q * reference.omega_B;
  const double lambda = std::sqrt(arm_B.norm() * force.norm() / kInertia.minCoeff());
  const double tolerance = std::pow(lambda * kStep, 4);
  EXPECT_GT(end.q.angularDistance(kStart), 0.05);  // it does turn [rad]
  EXPECT_LT(end.q.angularDistance(reference.q), tolerance);
  EXPECT_LT((end.omega - omega).norm(), tolerance * omega.norm());
  EXPECT_LT((end.v - reference.v).norm(), tolerance * reference.v.norm());
}

TEST(Push, AtTheCentreOfMassGivesForceTimesTimeOverMassInTheFramesOfTheReply) {
  const Vector3d force(3, -2, 5);
  const Push push({"--force", text(force), "--for", "0.5s"});
  EXPECT_EQ(push.last - push.first + 1, 30u);
  EXPECT_LT(push.frames.front().frame, push.first);
  expect_velocity_of_a_world_force(push, force);
  for (const Seen& seen : push.frames) EXPECT_EQ(seen.omega, Vector3d::Zero()) << seen.frame;
}

TEST(Push, OffTheCentreWithAWorldForceGivesTheSameVelocityAndTurnsTheBody) {
  const Vector3d force(3, -2, 5), at(0.2, 0.1, -0.15);
  const Push push({"--force", text(force), "--at", text(at), "--for", "0.5s"});
  expect_velocity_of_a_world_force(push, force);
  expect_reference(push, force, false, at);
}

TEST(Push, InBodyAxesTurnsWithTheBody) {
  const Vector3d force(3, -2, 5), at(0.2, 0.1, -0.15);
  const Push push({"--force", text(force), "--at", text(at), "--frame", "body", "--for", "0.5s"});
  expect_reference(push, force, true, at);
  // World axes would have given another velocity, by far.
  const Seen& end = push.frames.back();
  EXPECT_GT((end.v - force * 0.5 / kMass).norm(), 0.1);
}

TEST(Push, LeavesOtherBodiesAlone) {
  const TemporaryFile scene("free.yaml", kScene);
  const Daemon daemon(scene.path(), {"--paused"});
  ASSERT_EQ(client({"push", "probe", "--force", "100,0,0", "--for", "1s"}).code, 0);
  ASSERT_EQ(client_json({"step", "60"})["frame"], 60);
  const Json frame = client_json({"watch", "-n", "1", "--body", "bystander"});
  EXPECT_EQ(frame["frame"], 60);
  const Json body = frame["bodies"].at(0);
  EXPECT_EQ(vector(body["linear_velocity"]), Vector3d::Zero());
  EXPECT_EQ(vector(body["position"]), Vector3d(50, 0, 0));
}

TEST(Push, OfAnUnknownBodyNamesTheNearestOneAndFails) {
  const TemporaryFile scene("free.yaml", kScene);
  const Daemon daemon(scene.path());
  const Ended ended = client({"push", "prob", "--force", "1,0,0"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.errors.find("'probe'"), std::string::npos) << ended.errors;
}

TEST(Push, RefusesWhatItCannotRead) {
  for (const Words& options :
       {Words{}, Words{"--force", "1,2"}, Words{"--force", "1,2,nan"}, Words{"--force", "1,2,x"},
        Words{"--force", "1,0,0", "--for", "3 parsecs"}, Words{"--force", "1,0,0", "--for", "-1s"},
        Words{"--force", "1,0,0", "--frame", "moon"}, Words{"--force", "1,0,0", "--fro", "body"},
        Words{"--at-frame", "body", "--force", "1,0,0"},
        Words{"--force", "1,0,0", "--hold", "--for", "1s"}, Words{"--clear", "--force", "1,0,0"}}) {
    Words arguments = {"push", "probe"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = client(arguments);
    EXPECT_EQ(ended.code, 2) << Json(options).dump();
    EXPECT_EQ(ended.out, "") << Json(options).dump();
    EXPECT_NE(ended.errors, "") << Json(options).dump();
  }
}

}  // namespace
}  // namespace poinsot
