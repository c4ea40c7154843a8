// Sine and cosine with the same bits on every x86-64 machine.
//
// The C library picks its variant by CPU (with or without fused multiply-add), and the last bit
// differs. These are plain double arithmetic: reduction by π/2 in three parts (Cody and Waite) and
// the minimax polynomials of fdlibm's __kernel_sin and __kernel_cos. Error below 1 ulp for
// |x| < 1e5 rad; larger angles lose accuracy as the reduction does (about |x|·1e-33 absolute).

#pragma once

namespace poinsot {

struct SinCos {
  double sin;
  double cos;
};

SinCos sin_cos(double x);  // x [rad]

}  // namespace poinsot
