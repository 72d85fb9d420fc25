// Undriven motions, which neither constraints nor elastic stiffness determine: a mechanism needs a drive for each.
//
// They span the null space of [K B^T; B 0], with the stiffness K of the unloaded mechanism (no gravity, loads or
// reactions, which would give stiffness to a hanging pendulum). K is factorised with e D added, where D is the mean
// stiffness of each kind of unknown and e = 1e-9: (K + e D)^-1 e D is then the projection on that space, up to e.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct UndrivenMotions {
  /// A name is that of the coordinate that describes its motion best, of a joint if possible: "angle of joint 'arm'",
  /// "x at node 'b'".
  std::vector<std::string> names;
  MatrixX directions;  ///< (dofs, motions)
};

/// @param state  assembled state, with redundant constraints taken out
/// @param most   the search ends with this number of motions
UndrivenMotions find_undriven(const System& system, const Environment& environment, const State& state, int most = 12);

}  // namespace bielle::mechanism
