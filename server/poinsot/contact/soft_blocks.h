// The contacts of a soft step: coloured, four to a block, swept by kernels.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/contact_colors.h"
#include "poinsot/contact/soft_bodies.h"

namespace poinsot {

class SoftBlocks {
 public:
  explicit SoftBlocks(SoftKernels kernels = soft_kernels()) : kernels_(kernels) {}

  // Colours; then the blocks are to be packed, a piece at a time.
  void start(std::span<const SoftBody> bodies, std::span<const SoftManifold> manifolds,
             const SoftSettings& settings, double h);
  std::size_t pack_pieces() const;
  void pack(std::size_t piece, std::span<const SoftBody> bodies,
            std::span<const SoftManifold> manifolds, const SoftBodies& motion);
  void finish(std::span<SoftManifold> manifolds, SoftOutcome& outcome) const;

  // Sweeps go through runs of blocks, one run after another. A run is cut into pieces that may be
  // swept at once; runs too small for that are one piece.
  std::size_t runs() const { return runs_.size(); }
  std::size_t pieces(std::size_t run) const { return runs_[run].pieces; }
  void warm_start(SoftBodies& motion, std::size_t run, std::size_t piece);
  void push(SoftBodies& motion, std::size_t run, std::size_t piece);
  void relax(SoftBodies& motion, std::size_t run, std::size_t piece);
  void bounce(SoftBodies& motion, std::size_t run, std::size_t piece);

 private:
  struct Run {
    std::size_t first, last;  // blocks
    std::size_t pieces;
  };
  std::span<SoftBlock> blocks_of(std::size_t run, std::size_t piece);
  void add_run(std::size_t first, std::size_t last);
  void sort_by_count(std::span<const SoftManifold> manifolds);
  void pack_lane(const SoftManifold& manifold, int source, std::span<const SoftBody> bodies,
                 const SoftBodies& motion, SoftBlock& block, std::size_t lane) const;

  SoftKernels kernels_;
  SoftRates rates_ = {};
  double allowed_penetration_ = 0;
  ContactColors colors_;
  std::vector<ColorPair> pairs_;
  std::vector<int> order_;  // manifolds, four to a block; −1: none
  std::vector<SoftBlock> blocks_;
  std::vector<Run> runs_;
};

}  // namespace poinsot
