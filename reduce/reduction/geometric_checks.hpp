// Checks of a superelement's geometric stiffness against laws that need no stresses.
#pragma once

#include <vector>

#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

/// Rigid rotations against the virial of loads and inertia, and the elastic energy to third order in a turned frame.
void add_geometric_checks(const Superelement& body, std::vector<Check>& checks);

}  // namespace bielle::reduce
