// The contacts of a soft step: coloured, four to a block, swept by kernels.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/contact_colors.h"
#include "poinsot/contact/soft_bodies.h"

namespace poinsot {

class SoftBlocks {
 public:
  void start(std::span<const SoftBody> bodies, std::span<const SoftManifold> manifolds,
             const SoftBodies& motion, const SoftSettings& settings, double h);
  void finish(std::span<SoftManifold> manifolds, SoftOutcome& outcome) const;

  std::size_t size() const { return blocks_.size(); }
  // Runs of blocks that may be solved at once.
  std::size_t groups() const { return starts_.size() - 1; }
  std::size_t group_start(std::size_t k) const { return starts_[k]; }

  void note_approach(SoftBodies& motion);
  void warm_start(SoftBodies& motion);
  void push(SoftBodies& motion);
  void relax(SoftBodies& motion);
  void bounce(SoftBodies& motion);

 private:
  void pack(const SoftManifold& manifold, int source, std::span<const SoftBody> bodies,
            const SoftBodies& motion, SoftBlock& block, std::size_t lane) const;

  SoftKernels kernels_ = soft_kernels();
  SoftRates rates_ = {};
  double allowed_penetration_ = 0;
  ContactColors colors_;
  std::vector<ColorPair> pairs_;
  std::vector<SoftBlock> blocks_;
  std::vector<std::size_t> starts_ = {0};
};

}  // namespace poinsot
