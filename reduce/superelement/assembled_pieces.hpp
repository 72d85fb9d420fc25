// The pieces of a cut body, joined at the interfaces that they share, as one superelement.
#pragma once

#include <vector>

#include "reduce/superelement/superelement.hpp"

namespace bielle {

/// Stiffness, mass, damping and inertia components of all pieces together: their interfaces, each once, then their
/// modes, piece by piece. Mass properties are the sums. Geometric stiffness, loads, mesh and recovery remain with the
/// pieces.
Superelement assembled(const std::vector<Superelement>& pieces);

}  // namespace bielle
