// Mass, centre of mass and inertia: of particles, of each solid shape, of a compound.
//
// Source: lesson "Rigid Body Dynamics", slides "Center of Mass", "Mass and Inertia Tensor";
// polyhedra by integrals over the tetrahedra that its faces span with the origin.

#pragma once

#include <span>

#include "poinsot/math/pose.h"
#include "poinsot/math/types.h"
#include "poinsot/scene/shape.h"

namespace poinsot {

struct MassProperties {
  double mass = 0;                     // [kg]
  Vec3 center_of_mass = Vec3::Zero();  // [m] in the frame of the body (or shape)
  Mat3 J = Mat3::Zero();               // [kg·m²] about the centre of mass, axes of that frame
};

struct Particle {
  double mass = 0;            // [kg]
  Vec3 point = Vec3::Zero();  // [m]
};

// Volume of a solid shape [m³]; a half-space has none and may not be asked.
double volume(const Shape& shape);

// A homogeneous solid of the given density [kg/m³].
MassProperties mass_properties(const Shape& shape, double density);

MassProperties mass_properties(std::span<const Particle> particles);

// The same matter seen from a parent frame: pose of the child frame in the parent.
MassProperties transformed(const MassProperties& child, const Pose& pose);

// The sum of parts that are given in one frame.
MassProperties combined(std::span<const MassProperties> parts);

}  // namespace poinsot
