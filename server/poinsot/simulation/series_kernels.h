// The two products of series that nearly all the time of a Taylor step goes into, on raw arrays of
// whole vector registers. Chosen once by what the processor has; every width gives the same bits,
// because lanes never mix and nothing is fused.

#pragma once

namespace poinsot {

struct SeriesKernels {
  // sum = Σⱼ₌₀ᵏ nⱼ × ωₖ₋ⱼ for four vectors n at once. rows: k+1 blocks of 12, the x, y and z of
  // the four; flow: blocks of 8, of which 4 … 6 are ω; sum: 12.
  void (*cross)(const double* rows, const double* flow, int k, double* sum);
  // Σⱼ₌₀ᵏ aⱼ·bₖ₋ⱼ of blocks of 8.
  double (*dot)(const double* a, const double* b, int k);
};

SeriesKernels series_kernels();

}  // namespace poinsot
