#include "support/contact_oracle.h"

#include <cmath>

#include <Eigen/Dense>

namespace poinsot::test {
namespace {

constexpr double kSettled = 1e-14;  // [m/s] largest change of a sweep
constexpr int kMaxSweeps = 200000;
constexpr double kSlack = 1e-9;  // [m/s] of inequalities of an enumerated set

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Rows of each contact: normal and two tangents.
struct Dense {
  Eigen::MatrixXd J, inverse_mass;
  Eigen::VectorXd v;
};

Dense dense(const ContactProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.bodies.size());
  const auto m = static_cast<Eigen::Index>(problem.contacts.size());
  Dense d;
  d.J = Eigen::MatrixXd::Zero(3 * m, 6 * n);
  d.inverse_mass = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  d.v.resize(6 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactBody& body = problem.bodies[static_cast<std::size_t>(i)];
    d.inverse_mass.block<3, 3>(6 * i, 6 * i) = body.inv_mass * Mat3::Identity();
    d.inverse_mass.block<3, 3>(6 * i + 3, 6 * i + 3) = body.inv_J_W;
    d.v.segment<6>(6 * i) << body.v, body.omega;
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& contact = problem.contacts[static_cast<std::size_t>(i)];
    const Vec3 t = contact.normal.unitOrthogonal();
    const Vec3 axes[3] = {contact.normal, t, contact.normal.cross(t)};
    for (int k = 0; k < 3; ++k) {
      const auto put = [&](int body, double sign) {
        d.J.block<1, 3>(3 * i + k, 6 * body) = sign * axes[k].transpose();
        d.J.block<1, 3>(3 * i + k, 6 * body + 3) =
            sign * (contact.point - problem.bodies[at(body)].c).cross(axes[k]).transpose();
      };
      put(contact.a, 1);
      put(contact.b, -1);
    }
  }
  return d;
}

std::vector<ContactBody> with_velocities(const ContactProblem& problem, const Eigen::VectorXd& v) {
  std::vector<ContactBody> bodies = problem.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].v = v.segment<3>(static_cast<Eigen::Index>(6 * i));
    bodies[i].omega = v.segment<3>(static_cast<Eigen::Index>(6 * i + 3));
  }
  return bodies;
}

Vec3 step_to_cone(const Vec3& argument, double friction) {
  Vec3 result = argument;
  result[0] = std::max(0.0, argument[0]);
  const double length = std::hypot(argument[1], argument[2]), limit = friction * result[0];
  if (length > limit) result.tail<2>() *= limit / length;
  return result;
}

}  // namespace

std::optional<std::vector<ContactBody>> enumerate_frictionless(const ContactProblem& problem) {
  const Dense d = dense(problem);
  const int m = static_cast<int>(problem.contacts.size());
  for (unsigned set = 0; set < (1U << m); ++set) {
    std::vector<int> rows;
    for (int i = 0; i < m; ++i)
      if (set & (1U << i)) rows.push_back(i);
    const auto k = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd J(k, d.J.cols());
    Eigen::VectorXd wanted(k);
    for (Eigen::Index r = 0; r < k; ++r) {
      J.row(r) = d.J.row(3 * rows[static_cast<std::size_t>(r)]);
      wanted[r] = problem.target[at(rows[static_cast<std::size_t>(r)])] - J.row(r).dot(d.v);
    }
    Eigen::VectorXd v = d.v;
    if (k > 0) {
      const Eigen::MatrixXd W = J * d.inverse_mass * J.transpose();
      const Eigen::VectorXd impulses = W.fullPivLu().solve(wanted);
      if ((W * impulses - wanted).norm() > kSlack || impulses.minCoeff() < -kSlack) continue;
      v += d.inverse_mass * J.transpose() * impulses;
    }
    bool right = true;
    for (int i = 0; i < m; ++i) right &= d.J.row(3 * i).dot(v) >= problem.target[at(i)] - kSlack;
    if (right) return with_velocities(problem, v);
  }
  return std::nullopt;
}

std::optional<std::vector<ContactBody>> sweep_with_friction(const ContactProblem& problem) {
  const Dense d = dense(problem);
  const Eigen::MatrixXd W = d.J * d.inverse_mass * d.J.transpose();
  const Eigen::VectorXd free = d.J * d.v;
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(W.rows());
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < W.rows(); i += 3) {
      const double step = 1 / W.block<3, 3>(i, i).trace();
      Vec3 u = W.middleRows<3>(i) * impulses + free.segment<3>(i);
      u[0] -= problem.target[static_cast<std::size_t>(i / 3)];
      const Vec3 before = impulses.segment<3>(i);
      const Vec3 after = step_to_cone(before - step * u,
                                      problem.contacts[static_cast<std::size_t>(i / 3)].friction);
      impulses.segment<3>(i) = after;
      moved = std::max(moved, (after - before).norm() / step);
    }
    if (moved <= kSettled)
      return with_velocities(problem, d.v + d.inverse_mass * d.J.transpose() * impulses);
  }
  return std::nullopt;
}

ContactProblem random_contacts(unsigned seed, int bodies, int contacts, double friction,
                               bool approach) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(generator), normal(generator), normal(generator)); };
  ContactProblem problem;
  problem.add_ground();
  for (int i = 0; i < bodies; ++i) {
    const Vec3 size = Vec3::Ones() + 0.5 * Vec3(uniform(generator), uniform(generator), 0);
    const int box = problem.add_box(std::exp(uniform(generator)), size, 2 * vector(), vector());
    ContactBody& body = problem.bodies[at(box)];
    body.omega = vector();
    const Quat q = Quat(normal(generator), normal(generator), normal(generator), normal(generator))
                       .normalized();
    body.inv_J_W = q * body.inv_J_W * q.toRotationMatrix().transpose();
  }
  std::uniform_int_distribution<int> pick(0, bodies);
  while (static_cast<int>(problem.contacts.size()) < contacts) {
    const int a = pick(generator), b = pick(generator);
    if (a == b) continue;
    const Vec3 middle = a == 0   ? problem.bodies[at(b)].c
                        : b == 0 ? problem.bodies[at(a)].c
                                 : Vec3(0.5 * (problem.bodies[at(a)].c + problem.bodies[at(b)].c));
    const Vec3 point = middle + 0.5 * vector();
    Vec3 direction = vector().normalized();
    const ContactBody &x = problem.bodies[at(a)], &y = problem.bodies[at(b)];
    const Vec3 relative = x.v + x.omega.cross(point - x.c) - y.v - y.omega.cross(point - y.c);
    if (approach && relative.dot(direction) > 0) direction = -direction;
    problem.add_point(a, b, point, direction, friction);
  }
  return problem;
}

}  // namespace poinsot::test
