// Repair of curved elements that a curved boundary inverts.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Report of straighten_elements.
struct Straightening {
  int elements = 0;     ///< second-order elements whose Jacobian was not positive everywhere
  int nodes = 0;        ///< mid-side nodes moved to the middle of their edge
  double farthest = 0;  ///< longest way of a node [m]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< new place of that node
};

/// Moves the nodes of every cell of order 2 whose Jacobian may not be positive (may_be_inverted), but its vertices, to
/// the middles of its edges, until no such element is left. Neighbours share the nodes: an element that becomes invalid
/// by the move is straightened in turn. The process ends because straight elements are valid.
/// @param mesh  its straight elements must have positive volume (check_elements); cells of order 1 are left alone
Straightening straighten_elements(Mesh& mesh);

}  // namespace bielle::reduce
