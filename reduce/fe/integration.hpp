// Integration rules of the stiffness of cells, for the types that have more than one.
#pragma once

namespace bielle::reduce {

enum class Integration {
  standard,  ///< in full; hex8 and wedge6 with internal modes
  plain,     ///< in full, without internal modes: hex8 and wedge6 lock in bending, as C3D8 and C3D6 of other programs
  reduced    ///< hex20 with 2 x 2 x 2 points, as C3D20R of other programs; other cells as `standard`
};

}  // namespace bielle::reduce
