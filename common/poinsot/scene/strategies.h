// The closed sets of strategies and their names: the one table that scene files, the command line
// and parametrised tests read. A new strategy is one row here, one struct, one variant member.

#pragma once

#include <array>

#include "poinsot/base/names.h"

namespace poinsot {

enum class IntegratorKind { rk4, semi_implicit_euler };
inline constexpr std::array<Named<IntegratorKind>, 2> kIntegratorNames = {{
    {"rk4", IntegratorKind::rk4},
    {"semi_implicit_euler", IntegratorKind::semi_implicit_euler},
}};

enum class ImpactSearchKind { none };
inline constexpr std::array<Named<ImpactSearchKind>, 1> kImpactSearchNames = {{
    {"none", ImpactSearchKind::none},
}};

enum class ContactSolverKind { sequential_impulses };
inline constexpr std::array<Named<ContactSolverKind>, 1> kContactSolverNames = {{
    {"sequential_impulses", ContactSolverKind::sequential_impulses},
}};

}  // namespace poinsot
