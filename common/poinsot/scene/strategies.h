// The closed sets of strategies and their names: the one table that scene files, the command line
// and parametrised tests read. A new strategy is one row here, one struct, one variant member.

#pragma once

#include <array>
#include <cstdint>

#include "poinsot/base/names.h"

namespace poinsot {

enum class IntegratorKind {
  exact,
  taylor,
  dop853,
  dopri5,
  rk4,
  semi_implicit_euler,
  explicit_euler
};
inline constexpr std::array<Named<IntegratorKind>, 7> kIntegratorNames = {{
    {"exact", IntegratorKind::exact},
    {"taylor", IntegratorKind::taylor},
    {"dop853", IntegratorKind::dop853},
    {"dopri5", IntegratorKind::dopri5},
    {"rk4", IntegratorKind::rk4},
    {"semi_implicit_euler", IntegratorKind::semi_implicit_euler},
    {"explicit_euler", IntegratorKind::explicit_euler},
}};

// Those that choose their step by an error tolerance; the others take SimulationDef::step.
constexpr bool is_adaptive(IntegratorKind kind) {
  return kind <= IntegratorKind::dopri5;
}

// What moved one body in a frame. Its name is what reports and `poinsot status` show.
enum class Method : std::uint8_t {
  none,    // nothing: the body does not move
  flight,  // closed form from the start of the flight
  taylor,
  dop853,
  dopri5,
  rosenbrock,  // linearly implicit, where the springs are stiff
  rk4,
  semi_implicit_euler,
  explicit_euler,
};
inline constexpr std::array<Named<Method>, 9> kMethodNames = {{
    {"none", Method::none},
    {"flight", Method::flight},
    {"taylor", Method::taylor},
    {"dop853", Method::dop853},
    {"dopri5", Method::dopri5},
    {"rosenbrock", Method::rosenbrock},
    {"rk4", Method::rk4},
    {"semi_implicit_euler", Method::semi_implicit_euler},
    {"explicit_euler", Method::explicit_euler},
}};

// How impacts are found. `none`: fixed sub-steps with contacts that foresee.
enum class ImpactSearchKind { conservative, backtracking, continuous, none };
inline constexpr std::array<Named<ImpactSearchKind>, 4> kImpactSearchNames = {{
    {"conservative", ImpactSearchKind::conservative},
    {"backtracking", ImpactSearchKind::backtracking},
    {"continuous", ImpactSearchKind::continuous},
    {"none", ImpactSearchKind::none},
}};

// How standing contacts are solved. `auto`: each island by the cheapest that is accurate enough.
enum class ContactSolverKind { automatic, soft_step, convex_newton };
inline constexpr std::array<Named<ContactSolverKind>, 3> kContactSolverNames = {{
    {"auto", ContactSolverKind::automatic},
    {"soft_step", ContactSolverKind::soft_step},
    {"convex_newton", ContactSolverKind::convex_newton},
}};

// What a scene's defaults are made for.
enum class Profile { accurate, fast };
inline constexpr std::array<Named<Profile>, 2> kProfileNames = {{
    {"accurate", Profile::accurate},
    {"fast", Profile::fast},
}};

}  // namespace poinsot
