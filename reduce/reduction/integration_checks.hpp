// Checks of a requested integration of the stiffness: whether a mesh has cells that it concerns, and whether reduced
// integration has left modes that deform the body without energy.
#pragma once

#include <optional>

#include "reduce/reduction/basis.hpp"

namespace bielle::reduce {

/// @throws InputError about the key `integration` if no cell of the mesh is integrated otherwise by it
void check_integration(const Mesh& mesh, Integration integration);

/// A fixed-boundary mode in which the integration points see less deformation than there is.
struct HourglassMode {
  Eigen::Index mode = 0;  ///< from 0
  double ratio = 1;       ///< its strain energy with full integration over that of the mode
};

/// Returns the mode with the highest ratio, of a solid with reduced integration; nothing if the basis has no modes.
std::optional<HourglassMode> worst_hourglass_mode(const Solid& solid, const Basis& basis, int threads);

}  // namespace bielle::reduce
