// Which kernel serves which pair of shapes, as a matrix that shows its holes.
//
//   F  proximity_fcl.cpp  closed forms of FCL: sphere against sphere, box, capsule, cylinder
//   B  box_box.h          separating axes and clipping
//   G  gjk.h, epa.h       distance or penetration of cores, then clipping
//   H  half_space.h       closed forms
//   -  never meets: half-spaces belong to static bodies only

#pragma once

#include <array>
#include <cstddef>

#include "poinsot/scene/shape.h"

namespace poinsot {

inline constexpr std::size_t kShapeCount = kShapeNames.size();

// Upper triangle: rows are the first shape of the pair, which never comes later than the second.
inline constexpr std::array<std::array<char, kShapeCount + 1>, kShapeCount> kPairTable = {{
    //            sphere box capsule cylinder cone ellipsoid convex half_space
    /* sphere     */ {"FFFFGGGH"},
    /* box        */ {" BGGGGGH"},
    /* capsule    */ {"  GGGGGH"},
    /* cylinder   */ {"   GGGGH"},
    /* cone       */ {"    GGGH"},
    /* ellipsoid  */ {"     GGH"},
    /* convex     */ {"      GH"},
    /* half_space */ {"       -"},
}};

}  // namespace poinsot
