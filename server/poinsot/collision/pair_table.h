// Which kernel serves which pair of shapes, as a matrix that shows its holes.
//
//   F  proximity_fcl.cpp  closed forms of FCL: sphere against sphere, box, capsule, cylinder
//   B  box_box.h          separating axes and clipping
//   G  gjk.h, epa.h       distance or penetration of cores, then clipping
//   H  half_space.h       closed forms
//   M  mesh_pairs.h       a convex shape against the triangles near it
//   -  never meets: half-spaces and meshes belong to bodies that no force moves

#pragma once

#include <array>
#include <cstddef>

#include "poinsot/scene/shape.h"

namespace poinsot {

inline constexpr std::size_t kShapeCount = kShapeNames.size();

// Upper triangle: rows are the first shape of the pair, which never comes later than the second.
inline constexpr std::array<std::array<char, kShapeCount + 1>, kShapeCount> kPairTable = {{
    //            sphere box capsule cylinder cone ellipsoid convex half_space mesh
    /* sphere     */ {"FFFFGGGHM"},
    /* box        */ {" BGGGGGHM"},
    /* capsule    */ {"  GGGGGHM"},
    /* cylinder   */ {"   GGGGHM"},
    /* cone       */ {"    GGGHM"},
    /* ellipsoid  */ {"     GGHM"},
    /* convex     */ {"      GHM"},
    /* half_space */ {"       --"},
    /* mesh       */ {"        -"},
}};

}  // namespace poinsot
