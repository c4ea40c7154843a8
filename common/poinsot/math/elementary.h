// Sine, cosine, exponential and logarithm with the same bits on every x86-64 machine.
//
// The C library picks its variant by CPU (with or without fused multiply-add), and the last bit
// differs. These are plain double arithmetic: reduction by π/2 in three parts (Cody and Waite) and
// the minimax polynomials of fdlibm's __kernel_sin and __kernel_cos. Error below 1 ulp for
// |x| < 1e6 rad; beyond, the reduction loses |x|·1e-16 rad: long phases are reduced by Phase
// (phase.h) first.

#pragma once

namespace poinsot {

struct SinCos {
  double sin;
  double cos;
};

SinCos sin_cos(double x);  // x [rad]

// eˣ for |x| < 700, error below 1.5 ulp.
double exponential(double x);

// ln x for normal x > 0, error below 2 ulp or 1e-16; xʸ for x > 0 as e^(y ln x).
double logarithm(double x);
double power(double x, double y);

// eˣ in extended precision for |x| < 11000, relative error below 4e-19.
long double exponential(long double x);

}  // namespace poinsot
