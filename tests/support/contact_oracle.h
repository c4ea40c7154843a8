// Independent, slow and dense answers to small contact problems.

#pragma once

#include <optional>
#include <random>
#include <vector>

#include "support/contact_scenes.h"

namespace poinsot::test {

// Velocities of all bodies without friction: tries every set of pushing contacts and takes the one
// that is right. Contacts: at most 12, none redundant. The velocities are unique.
std::optional<std::vector<ContactBody>> enumerate_frictionless(const ContactProblem& problem);

// With friction: block Gauss–Seidel on the dense Delassus matrix, each contact solved by projected
// fixed-point steps, until no impulse moves. Nothing if that does not happen.
std::optional<std::vector<ContactBody>> sweep_with_friction(const ContactProblem& problem);

// Turned boxes of different masses in random motion, at random points with random normals, target
// zero. With `approach`, every contact closes.
ContactProblem random_contacts(unsigned seed, int bodies, int contacts, double friction,
                               bool approach = false);

}  // namespace poinsot::test
