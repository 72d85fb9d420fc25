// Repair of curved elements that a curved boundary turns inside out.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// What straighten_elements did.
struct Straightening {
  int elements = 0;     ///< second-order elements whose Jacobian was not positive everywhere
  int nodes = 0;        ///< mid-side nodes moved to the middle of their edge
  double farthest = 0;  ///< longest way of a node [m]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< where that node is now
};

/// Moves the mid-side nodes of every tet10 whose Jacobian is not surely positive to the middles of their edges, until
/// no such element is left. Neighbours share the nodes: an element that becomes invalid by the move is straightened in
/// turn, which ends because straight elements are valid.
/// @param mesh  its straight elements must have positive volume (check_elements); a mesh without tet10 is left alone
Straightening straighten_elements(Mesh& mesh);

}  // namespace bielle::reduce
