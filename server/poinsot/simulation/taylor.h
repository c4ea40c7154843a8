// Taylor series of a system: the coefficients of the motion in time, by recurrence, with all forces
// inside the recurrence.
//
// A push that is constant over the step in W, in B, or in W at a point of the body is integrated
// without discretisation error; drag and springs enter through recurrences for products, square
// roots and reciprocals. Orientation is carried as the rows of R, each a vector constant in W seen
// from B (n′ = n × ω), because every push constant in W is linear in them.
//
// The order is what the decay of the coefficients asks for, at most kMaxOrder; a step that needs
// more is divided, again by the decay. The error of a step is estimated by its last terms.
// Source: Jorba, Zou, A software package for the numerical integration of ODEs by means of
// high-order Taylor methods, 2005. README.md, "Taylor series".

#pragma once

#include <array>
#include <vector>

#include "poinsot/simulation/body_system.h"
#include "poinsot/simulation/local_error.h"
#include "poinsot/simulation/series_kernels.h"

namespace poinsot {

class TaylorSeries {
 public:
  static constexpr int kMaxOrder = 18;

  // For systems of up to `bodies` bodies and `springs` springs.
  void prepare(std::size_t bodies, std::size_t springs);

  // The series at y up to `order`: a fixed order, for tests and comparisons.
  void expand(const System& system, const SystemState& y, int order);

  // y at h [s] from where the series was expanded, and the size of its last terms.
  void evaluate(const System& system, double h, SystemState& y) const;
  LocalError last_terms(const System& system, double h) const;

  // Moves y by `duration` in as few steps as `tolerance` allows: the last two terms of each step
  // stay below it, relative to each quantity's scale. False if a step would be shorter than
  // duration / `most_steps` or the series does not exist (a drag law at its kink, a spring of no
  // length): y is then somewhere on the way. Adds to `error`.
  bool advance(const System& system, SystemState& y, double duration, double tolerance,
               int most_steps, LocalError& error);

 private:
  template <class T>
  using Series = std::array<T, kMaxOrder + 2>;  // coefficients of 1, t, t², …

  struct Body {
    SeriesBody acts = {};
    std::array<SeriesBlock, kMaxOrder + 2> at = {};
    std::array<EffortBlock, kMaxOrder + 2> effort = {};
    Series<double> speed_squared, speed;  // for quadratic drag
    SeriesSquares squares;                // of the latest order

    Eigen::Map<const Eigen::Matrix<double, 3, 3>, 0, Eigen::OuterStride<4>> R(std::size_t k) const {
      return Eigen::Map<const Eigen::Matrix<double, 3, 3>, 0, Eigen::OuterStride<4>>(
          at[k].rows.data());
    }
    void add_to_m(std::size_t k, const Vec3& rate);
    Eigen::Map<const Vec3> c(std::size_t k) const { return of(at[k].c_W); }
    Eigen::Map<const Vec3> v(std::size_t k) const { return of(at[k].v); }
    Eigen::Map<const Vec3> omega(std::size_t k) const { return of(at[k].omega); }

    static Eigen::Map<const Vec3> of(const std::array<double, 4>& lanes) {
      return Eigen::Map<const Vec3>(lanes.data());
    }
    static Eigen::Map<Vec3> of(std::array<double, 4>& lanes) {
      return Eigen::Map<Vec3>(lanes.data());
    }
  };
  struct Spring {
    Series<Vec3> d, force, lever_a, lever_b;  // x_a − x_b, on a, R p; in W
    Series<double> squared, length, inverse, inverse_squared, closing, damping, factor;
  };
  struct Scale {
    double v, m;  // 1/[m/s]², 1/[kg·m²/s]²
  };

  void bring(const System& system);
  void start(const System& system, const SystemState& y);
  bool add_order(const System& system, int k);
  void find_scales(const System& system, double h);
  double work_scale(const System& system, double h) const;
  double squared_term(const System& system) const;
  bool passed_standstill(const System& system, double h, const SystemState& y) const;

  static bool add_drag(const DragDef& drag, Body& series, std::size_t k);
  void separate(const SpringLink& link, Spring& spring, std::size_t k) const;
  void add_linear(const SpringLink& link, Spring& spring, std::size_t k);
  bool add_spring(const SpringLink& link, Spring& spring, std::size_t k);
  void pull(int index, const Vec3& p, const Series<Vec3>& lever, const Series<Vec3>& force,
            double sign, std::size_t k);

  SeriesKernels kernels_ = series_kernels();
  std::vector<Body> series_;
  std::vector<Spring> springs_;
  std::vector<Scale> scales_;
  double work_scale_ = 0;  // 1/[J]² of what isotropic springs damp; 0: none does
  int order_ = 0;
};

}  // namespace poinsot
