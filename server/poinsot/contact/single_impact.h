// The impact of two bodies at one point, with restitution and Coulomb friction.
//
// The normal impulse p grows from 0; the bodies do not move meanwhile, and
//
//     du/dp = A (n + f),   f = −μ ut/|ut| while it slips,
//                          f = −Att⁻¹ Atn while it sticks, if |f| ≤ μ; else it slips off again.
//
// Compression ends where un = 0, the impact where the work of restitution is e² that of compression
// (Stronge): so no impact gains energy, whatever slip does in between. Straight slip is in closed
// form, curved slip is integrated to some 1e-11. Painlevé's rod is no exception: pressed harder by
// its slip it is compressed until slip ends, and ends always, since p·A p > 0.
//
// Source: Stronge, Rigid body collisions with friction (1990); Batlle, Rough balanced collisions
// (1996).

#pragma once

#include <optional>

#include "poinsot/math/types.h"

namespace poinsot {

// The impulse [N·s] in the point's frame (two tangents and the normal). A [1/kg]: symmetric,
// positive definite; u [m/s] before it. Zero if the point does not approach. None if slip could not
// be followed.
std::optional<Vec3> single_impact(const Mat3& A, const Vec3& u, double restitution,
                                  double friction);

}  // namespace poinsot
