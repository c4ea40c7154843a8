#include "poinsot/contact/soft_joints.h"

#include <Eigen/LU>

#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

Mat3 matrix_of(const std::array<double, 6>& m) {
  Mat3 full;
  full << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return full;
}

struct Side {
  HotBody& hot;
  double inv_mass;
  Mat3 inv_J_W;
  Vec3 arm;
  bool moves;

  Side(SoftBodies& bodies, int k, const Vec3& start_arm)
      : hot(bodies.hot()[k]),
        inv_mass(bodies.masses()[k].inv_mass),
        inv_J_W(matrix_of(bodies.masses()[k].inv_J_W)),
        arm(Quat(hot.turn[3], hot.turn[0], hot.turn[1], hot.turn[2]) * start_arm),
        moves(bodies.moves(k)) {}

  Vec3 velocity() const {
    return Vec3(hot.v[0], hot.v[1], hot.v[2]) +
           Vec3(hot.omega[0], hot.omega[1], hot.omega[2]).cross(arm);
  }
  Mat3 response() const {
    const Mat3 x = cross_matrix(arm);
    return inv_mass * Mat3::Identity() - x * inv_J_W * x;
  }
  // Bodies carry the impulse on from sub-step to sub-step; its arm has turned since.
  void follow(Vec3& last_arm, const Vec3& impulse) {
    turn((arm - last_arm).cross(impulse));
    last_arm = arm;
  }
  void turn(const Vec3& couple) {
    if (!moves) return;
    const Vec3 omega = inv_J_W * couple;
    hot.omega += Lanes{omega.x(), omega.y(), omega.z(), 0};
  }
  void apply(const Vec3& impulse) {
    if (!moves) return;
    const Vec3 v = inv_mass * impulse;
    hot.v += Lanes{v.x(), v.y(), v.z(), 0};
    turn(arm.cross(impulse));
  }
};

}  // namespace

void SoftJoints::start(std::span<const SoftBody> bodies, std::span<const PointJoint> joints) {
  arms_.clear();
  for (const PointJoint& joint : joints) {
    const Vec3 a = joint.point - bodies[static_cast<std::size_t>(joint.a)].c;
    const Vec3 b = joint.point - bodies[static_cast<std::size_t>(joint.b)].c;
    arms_.push_back({a, b, a, b});
  }
}

void SoftJoints::warm_start(std::span<const PointJoint> joints, SoftBodies& bodies) {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    Side(bodies, joints[k].a, arms_[k].a).apply(joints[k].impulse);
    Side(bodies, joints[k].b, arms_[k].b).apply(-joints[k].impulse);
  }
}

void SoftJoints::solve(std::span<PointJoint> joints, SoftBodies& bodies, bool to_target) {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    PointJoint& joint = joints[k];
    Side a(bodies, joint.a, arms_[k].a), b(bodies, joint.b, arms_[k].b);
    if (to_target) {
      a.follow(arms_[k].last_a, joint.impulse);
      b.follow(arms_[k].last_b, -joint.impulse);
    }
    Vec3 off = a.velocity() - b.velocity();
    if (to_target) off -= joint.target;
    const Mat3 response = a.response() + b.response();
    if (!(response.determinant() > 0)) continue;  // nothing moves
    const Vec3 impulse = -(response.inverse() * off);
    joint.impulse += impulse;
    a.apply(impulse);
    b.apply(-impulse);
  }
}

}  // namespace poinsot
