#include "poinsot/contact/impact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "poinsot/contact/single_impact.h"

namespace poinsot {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

bool moves(const ContactBody& body) {
  return body.inv_mass > 0;
}

Vec3 speed_at(const ContactBody& body, const Vec3& point) {
  return body.v + body.omega.cross(point - body.c);
}

// Columns: two tangents and the normal.
Mat3 frame_of(const Vec3& normal) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  Mat3 frame;
  frame.col(0) = normal.cross(Vec3::Unit(least)).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

// What a unit impulse on the body at one point, along the axes of one frame, adds to the velocity
// at another [1/kg].
Mat3 response(const ContactBody& body, const Vec3& to, const Mat3& to_frame, const Vec3& from,
              const Mat3& from_frame) {
  Mat3 arm_to, arm_from;
  for (int k = 0; k < 3; ++k) {
    arm_to.col(k) = (to - body.c).cross(to_frame.col(k));
    arm_from.col(k) = (from - body.c).cross(from_frame.col(k));
  }
  return body.inv_mass * (to_frame.transpose() * from_frame) +
         arm_to.transpose() * (body.inv_J_W * arm_from);
}

// Of all bodies that two points share.
Mat3 coupling(std::span<const ContactBody> bodies, const ImpactPoint& to, const Mat3& to_frame,
              const ImpactPoint& from, const Mat3& from_frame) {
  Mat3 sum = Mat3::Zero();
  const auto add = [&](int body, double sign) {
    const ContactBody& shared = bodies[at(body)];
    if (moves(shared)) sum += sign * response(shared, to.point, to_frame, from.point, from_frame);
  };
  if (to.a == from.a) add(to.a, 1);
  if (to.b == from.b) add(to.b, 1);
  if (to.a == from.b) add(to.a, -1);
  if (to.b == from.a) add(to.b, -1);
  return sum;
}

void push(ContactBody& body, const Vec3& point, const Vec3& impulse) {
  // A body that does not move is shared by many: nothing may touch it.
  if (!moves(body)) return;
  body.v += body.inv_mass * impulse;
  body.omega += body.inv_J_W * (point - body.c).cross(impulse);
}

}  // namespace

int ImpactSolver::group_of(int point) {
  while (parent_[at(point)] != point) {
    parent_[at(point)] = parent_[at(parent_[at(point)])];
    point = parent_[at(point)];
  }
  return point;
}

void ImpactSolver::find_groups(std::span<const ContactBody> bodies,
                               std::span<const ImpactPoint> points) {
  const int n = static_cast<int>(points.size());
  parent_.resize(points.size());
  last_of_body_.assign(bodies.size(), -1);
  order_.clear();
  for (int i = 0; i < n; ++i) {
    parent_[at(i)] = i;
    const ImpactPoint& point = points[at(i)];
    if (!moves(bodies[at(point.a)]) && !moves(bodies[at(point.b)])) continue;
    order_.push_back(i);
    for (const int body : {point.a, point.b}) {
      if (!moves(bodies[at(body)])) continue;
      int& last = last_of_body_[at(body)];
      if (last >= 0) {
        const int one = group_of(last), other = group_of(i);
        parent_[at(std::max(one, other))] = std::min(one, other);
      }
      last = i;
    }
  }
  for (int i = 0; i < n; ++i) parent_[at(i)] = group_of(i);
  std::sort(order_.begin(), order_.end(), [this](int i, int j) {
    return parent_[at(i)] != parent_[at(j)] ? parent_[at(i)] < parent_[at(j)] : i < j;
  });
}

bool ImpactSolver::assemble(std::span<const ContactBody> bodies,
                            std::span<const ImpactPoint> points) {
  const std::size_t n = members_.size();
  frames_.resize(n);
  speed_.resize(3 * n);
  impulse_.resize(3 * n);
  inverse_mass_.resize(9 * n * n);
  restitution_.resize(n);
  friction_.resize(n);
  Eigen::Map<Eigen::MatrixXd> A(inverse_mass_.data(), static_cast<Eigen::Index>(3 * n),
                                static_cast<Eigen::Index>(3 * n));
  for (std::size_t i = 0; i < n; ++i) {
    const ImpactPoint& point = points[at(members_[i])];
    frames_[i] = frame_of(point.normal);
    restitution_[i] = std::clamp(point.restitution, 0.0, 1.0);
    friction_[i] = std::max(point.friction, 0.0);
    const Vec3 u = frames_[i].transpose() * (speed_at(bodies[at(point.a)], point.point) -
                                             speed_at(bodies[at(point.b)], point.point));
    const auto row = static_cast<Eigen::Index>(3 * i);
    for (Eigen::Index k = 0; k < 3; ++k) speed_[at(row + k)] = u[k];
    for (std::size_t j = 0; j <= i; ++j) {
      const auto column = static_cast<Eigen::Index>(3 * j);
      const Mat3 block = coupling(bodies, point, frames_[i], points[at(members_[j])], frames_[j]);
      A.block<3, 3>(row, column) = i == j ? Mat3(0.5 * (block + block.transpose())) : block;
      A.block<3, 3>(column, row) = A.block<3, 3>(row, column).transpose().eval();
    }
    if (!(A(row + 2, row + 2) > 0) || !u.allFinite()) return false;
  }
  return A.allFinite();
}

void ImpactSolver::resolve_group(std::span<ContactBody> bodies, std::span<ImpactPoint> points,
                                 ImpactOutcome& outcome) {
  if (!assemble(bodies, points)) {
    outcome.converged = false;
    return;
  }
  const std::size_t n = members_.size();
  const ImpactSystem system{static_cast<Eigen::Index>(n), inverse_mass_.data(), speed_.data(),
                            restitution_.data(), friction_.data()};
  std::optional<Vec3> alone;
  if (n == 1) {
    alone = single_impact(Eigen::Map<const Mat3>(inverse_mass_.data()),
                          Eigen::Map<const Vec3>(speed_.data()), restitution_[0], friction_[0]);
    if (!alone) outcome.converged = false;
  }
  if (alone) {
    Eigen::Map<Vec3>(impulse_.data()) = *alone;
    if (alone->z() > 0) ++outcome.passes;
  } else {
    const SimultaneousImpact::Result result = simultaneous_.resolve(system, impulse_);
    outcome.passes += result.passes;
    if (!result.converged) outcome.converged = false;
  }
  const VectorView p(impulse_.data(), static_cast<Eigen::Index>(3 * n));
  if (!p.allFinite()) {
    outcome.converged = false;
    return;
  }
  outcome.energy_lost -= p.dot(system.speed()) + 0.5 * p.dot(system.inverse_mass().lazyProduct(p));
  for (std::size_t i = 0; i < n; ++i) {
    ImpactPoint& point = points[at(members_[i])];
    point.impulse = frames_[i] * Eigen::Map<const Vec3>(&impulse_[3 * i]);
    push(bodies[at(point.a)], point.point, point.impulse);
    push(bodies[at(point.b)], point.point, -point.impulse);
  }
}

ImpactOutcome ImpactSolver::resolve(std::span<ContactBody> bodies, std::span<ImpactPoint> points) {
  ImpactOutcome outcome;
  for (ImpactPoint& point : points) point.impulse.setZero();
  find_groups(bodies, points);
  for (std::size_t begin = 0; begin < order_.size();) {
    std::size_t end = begin + 1;
    while (end < order_.size() && parent_[at(order_[end])] == parent_[at(order_[begin])]) ++end;
    members_ = {order_.data() + begin, end - begin};
    resolve_group(bodies, points, outcome);
    begin = end;
  }
  return outcome;
}

}  // namespace poinsot
