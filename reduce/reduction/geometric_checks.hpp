// Checks of a superelement's geometric stiffness by laws that involve no stresses.
#pragma once

#include <vector>

#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

/// Compares rigid rotations with the virial of loads and inertia, and checks the elastic energy to third order in a
/// turned frame.
void add_geometric_checks(const Superelement& body, std::vector<Check>& checks);

}  // namespace bielle::reduce
