#include "poinsot/contact/newton_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace poinsot {
namespace {

constexpr int kUnsound = -2;
// [-] of the mean inverse inertia: what a body that turns about some axes only has about the rest.
constexpr double kLeastTurn = 1e-12;
// [-] velocities at points are sums of this many roundings.
constexpr double kRoundings = 8;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Vec3 perpendicular(const Vec3& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  return n.cross(Vec3::Unit(least)).normalized();
}

bool sound(const ContactBody& body) {
  return std::isfinite(body.c.sum() + body.v.sum() + body.omega.sum() + body.inv_mass +
                       body.inv_J_W.sum()) &&
         std::isfinite(1 / body.inv_mass) == (body.inv_mass > 0);
}

Vec3 within_cone(const Vec3& impulse, double friction) {
  const ConeArgument z{impulse[0], {impulse[1], impulse[2]}, 0, std::hypot(impulse[1], impulse[2])};
  return nearest_in_cone(z, friction, ConeScale::of(1, 1)).impulse;
}

// [1/kg] of a unit impulse at the point, along the axes of its frame.
Vec3 inverse_masses(const NewtonBody& body, const Vec3& arm, const Mat3& frame) {
  Vec3 result;
  for (int k = 0; k < 3; ++k) {
    const Vec3 lever = arm.cross(frame.col(k));
    result[k] = body.inv_mass + lever.dot(body.inv_J * lever);
  }
  return result;
}

}  // namespace

void NewtonProblem::load_bodies(std::span<const ContactBody> from) {
  moving_.resize(from.size());
  bodies.clear();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const ContactBody& source = from[i];
    moving_[i] = !sound(source) ? kUnsound : kFixed;
    if (moving_[i] == kUnsound || !(source.inv_mass > 0)) continue;
    moving_[i] = static_cast<int>(bodies.size());
    NewtonBody& body = bodies.emplace_back();
    body.index = static_cast<int>(i);
    body.c = source.c;
    body.inv_mass = source.inv_mass;
    body.mass = 1 / source.inv_mass;
    body.inv_J = 0.5 * (source.inv_J_W + source.inv_J_W.transpose());
    const double mean = body.inv_J.trace() / 3;
    body.turns = mean > 0;
    Mat3 turn = body.turns ? body.inv_J : Mat3(Mat3::Identity());
    if (!body.turns) body.inv_J.setZero();
    if (!(turn.determinant() > kLeastTurn * mean * mean * mean))
      turn += kLeastTurn * (body.turns ? mean : 1.0) * Mat3::Identity();
    body.J = turn.inverse();
    body.v_free = body.v = source.v;
    body.omega_free = body.omega = source.omega;
    body.reach = 0;
  }
  double least = 0, largest = 0;
  for (const NewtonBody& body : bodies) {
    least = least > 0 ? std::min(least, body.mass) : body.mass;
    largest = std::max(largest, body.mass);
  }
  mass_ratio = largest > 0 ? largest / least : 1.0;
}

void NewtonProblem::add(NewtonPoint& point, const Vec3& place, std::span<const ContactBody> from,
                        int a, int b, Vec3 carried) {
  point.a = moving_[at(a)];
  point.b = moving_[at(b)];
  if (point.a == kUnsound || point.b == kUnsound || point.a == point.b) return;
  Vec3 w = Vec3::Zero();
  const auto side = [&](int source, int body, double sign, Vec3& arm) {
    arm = place - from[at(source)].c;
    if (body == kFixed) {
      carried += sign * (from[at(source)].v + from[at(source)].omega.cross(arm));
      return;
    }
    NewtonBody& mine = bodies[at(body)];
    if (!mine.turns) {
      carried += sign * mine.omega_free.cross(arm);
      arm.setZero();
    }
    mine.reach = std::max(mine.reach, arm.norm());
    w += inverse_masses(mine, arm, point.frame);
  };
  side(a, point.a, 1, point.arm_a);
  side(b, point.b, -1, point.arm_b);
  point.carried = point.frame.transpose() * carried;
  point.w_normal = point.joint ? w.mean() : w[0];
  point.w_tangent = point.joint ? w.mean() : 0.5 * (w[1] + w[2]);
  if (!std::isfinite(w.sum() + point.carried.sum() + 1 / w.minCoeff())) return;
  if (!std::isfinite(point.trial.sum())) point.trial.setZero();
  point.moved.setZero();
  points.push_back(point);
}

void NewtonProblem::load(std::span<const ContactBody> from, std::span<const Contact> contacts,
                         std::span<const double> target, std::span<const PointJoint> joints,
                         bool frictional, bool warm) {
  load_bodies(from);
  points.clear();
  softness_ = 0;
  NewtonPoint point;
  point.joint = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const double sum = contact.point.sum() + contact.normal.sum() + contact.friction +
                       contact.carried.sum() + target[i];
    if (!std::isfinite(sum + 1 / contact.normal.squaredNorm())) continue;
    const Vec3 t = perpendicular(contact.normal);
    point.frame << contact.normal, t, contact.normal.cross(t);
    point.source = static_cast<int>(i);
    point.friction = frictional ? std::max(0.0, contact.friction) : 0.0;
    point.target = Vec3(target[i], 0, 0);
    point.trial.setZero();
    if (warm) {
      point.trial = point.frame.transpose() * contact.friction_impulse;
      point.trial[0] = contact.normal_impulse;
      point.trial = within_cone(point.trial, point.friction);
    }
    add(point, contact.point, from, contact.a, contact.b, contact.carried);
  }
  point.joint = true;
  point.frame.setIdentity();
  point.friction = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const PointJoint& joint = joints[i];
    if (!std::isfinite(joint.point.sum() + joint.target.sum())) continue;
    point.source = static_cast<int>(i);
    point.target = joint.target;
    point.trial = warm ? joint.impulse : Vec3(Vec3::Zero());
    add(point, joint.point, from, joint.a, joint.b, Vec3::Zero());
  }
  pushes_.resize(bodies.size());
  moments_.resize(bodies.size());
}

SolveResidual NewtonProblem::follow_trial() {
  std::ranges::fill(pushes_, Vec3::Zero());
  std::ranges::fill(moments_, Vec3::Zero());
  for (const NewtonPoint& p : points) {
    const Vec3 impulse = p.frame * p.trial;
    if (p.a != kFixed) {
      pushes_[at(p.a)] += impulse;
      moments_[at(p.a)] += p.arm_a.cross(impulse);
    }
    if (p.b != kFixed) {
      pushes_[at(p.b)] -= impulse;
      moments_[at(p.b)] -= p.arm_b.cross(impulse);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    NewtonBody& body = bodies[i];
    body.v = body.v_free + body.inv_mass * pushes_[i];
    body.omega = body.omega_free + body.inv_J * moments_[i];
  }
  for (NewtonPoint& p : points) {
    Vec3 relative = Vec3::Zero();
    if (p.a != kFixed) relative += bodies[at(p.a)].v + bodies[at(p.a)].omega.cross(p.arm_a);
    if (p.b != kFixed) relative -= bodies[at(p.b)].v + bodies[at(p.b)].omega.cross(p.arm_b);
    p.trial_velocity = p.frame.transpose() * relative + p.carried;
  }
  return measure_trial();
}

void NewtonProblem::accept_trial() {
  for (NewtonPoint& p : points) {
    p.start = p.trial;
    p.velocity = p.trial_velocity;
    p.speed = std::sqrt(p.velocity[1] * p.velocity[1] + p.velocity[2] * p.velocity[2]);
  }
}

SolveResidual NewtonProblem::measure_trial() const {
  SolveResidual result;
  double finite = 0;  // NaN passes through maxima unseen
  for (const NewtonPoint& p : points) {
    finite += 0 * (p.trial.sum() + p.trial_velocity.sum());
    const Vec3 beside = p.trial_velocity - p.target;
    if (p.joint) {
      result.joint = std::max(result.joint, beside.norm());
      continue;
    }
    result.normal = std::max(result.normal, std::abs(std::min(p.trial[0] * p.w_normal, beside[0])));
    const double y[2] = {p.w_tangent * p.trial[1] - beside[1],
                         p.w_tangent * p.trial[2] - beside[2]};
    const double length = std::sqrt(y[0] * y[0] + y[1] * y[1]);
    const double limit = p.w_tangent * p.friction * p.trial[0];
    const double scale = length > limit ? limit / length : 1.0;
    const double e[2] = {p.w_tangent * p.trial[1] - scale * y[0],
                         p.w_tangent * p.trial[2] - scale * y[1]};
    result.friction = std::max(result.friction, std::sqrt(e[0] * e[0] + e[1] * e[1]));
  }
  if (!(finite == 0)) result.normal = std::numeric_limits<double>::infinity();
  return result;
}

void NewtonProblem::set_softness(double softness) {
  if (softness == softness_) return;
  softness_ = softness;
  for (NewtonPoint& p : points)
    p.scale = ConeScale::of(softness * p.w_normal, softness * p.w_tangent);
}

double NewtonProblem::largest_load() const {
  double largest = 0;
  for (const NewtonPoint& p : points)
    if (!p.joint) largest = std::max(largest, p.w_normal * p.start[0]);
  return largest;
}

double NewtonProblem::rounding() const {
  double largest = 0;
  for (const NewtonBody& body : bodies)
    largest = std::max(largest, body.v_free.norm() + body.reach * body.omega_free.norm());
  for (const NewtonPoint& p : points)
    largest = std::max({largest, p.w_normal * std::abs(p.start[0]),
                        p.w_tangent * (std::abs(p.start[1]) + std::abs(p.start[2]))});
  return kRoundings * std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace poinsot
