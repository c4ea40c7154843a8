// Embedded Runge–Kutta pairs: adaptive steps, error estimate, dense output.
//
// A step is accepted when its estimated error is below the tolerance relative to each quantity's
// scale: 1 for orientations [rad], for c, P and m their own size or what they change by in the
// step, whichever is larger. Step sizes follow a PI controller and are kept from one call to the
// next. Source: Hairer, Nørsett, Wanner, Solving ODEs I, II.4–II.6; IV.2 for the detection of
// stiffness.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/simulation/body_system.h"
#include "poinsot/simulation/local_error.h"

namespace poinsot {

// A method as data. Stages count from 0; the stage after the last is f at the end of the step.
struct EmbeddedPair {
  struct Term {
    int stage;
    double weight;
  };
  using Row = std::span<const Term>;

  int order, error_order;
  std::span<const Row> stages;  // stage 1 and on, from the ones before
  Row solution;
  Row error, error3;           // of orders 5 and 3 for DOP853, else one
  std::span<const Row> extra;  // further stages, for dense output
  std::span<const Row> dense;  // further coefficients of dense output
  double beta;                 // of the PI controller
  double least_factor, most_factor;
  double stiff;  // h |λ| beyond which the step is bounded by stability
};
extern const EmbeddedPair kDopri5;
extern const EmbeddedPair kDop853;

// What a system keeps between calls.
struct StepMemory {
  double h = 0;           // [s] next step; 0: unknown
  double last_error = 1;  // of the last accepted step, over the tolerance
  int stiff_steps = 0;    // in a row
  bool stiff = false;     // for good: integrate it implicitly

  // Of the fixed-step methods.
  LocalError step_error;       // of one step, when it was last estimated
  std::uint32_t advances = 0;  // so far

  bool operator==(const StepMemory&) const = default;
  template <class Archive>
  void archive(Archive& with) {
    with(h, last_error, stiff_steps, stiff, step_error, advances);
  }
};

// The largest error of a step of h against its scale; infinite if anything is not finite.
double relative_error(const System& system, const SystemState& from, const SystemState& to,
                      const SystemState& rate, const SystemState& error, double h,
                      double tolerance);

class EmbeddedRungeKutta {
 public:
  // For systems of up to n bodies.
  void prepare(Eigen::Index n);

  // Moves y by `duration`. False if the system turned out stiff or more than `most_steps` would be
  // needed: y is then as far as memory and `done` [s] say. Adds to `error`.
  bool advance(const EmbeddedPair& pair, const System& system, SystemState& y, double duration,
               double tolerance, int most_steps, StepMemory& memory, LocalError& error,
               double& done);

  // One step of h, whatever its error: y → end(); afterwards dense() interpolates in it.
  void step(const EmbeddedPair& pair, const System& system, const SystemState& y, double h);
  const SystemState& end() const { return end_; }
  double error_of_step(const EmbeddedPair& pair, const System& system, const SystemState& y,
                       double h, double tolerance);  // relative to the scales
  // The state at y + θ h of the last step, 0 ≤ θ ≤ 1; of the pair's order less one.
  void dense(const EmbeddedPair& pair, const System& system, const SystemState& y, double h,
             double theta, SystemState& at);

 private:
  void combine(const SystemState& y, double h, EmbeddedPair::Row row, SystemState& out) const;
  bool looks_stiff(const EmbeddedPair& pair, double h) const;

  std::vector<SystemState> k_;  // stages
  SystemState stage_, end_, error_, error3_;
};

}  // namespace poinsot
