// Repair of curved elements that a curved boundary inverts.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Report of straighten_elements.
struct Straightening {
  int elements = 0;     ///< second-order elements whose Jacobian was not positive everywhere
  int nodes = 0;        ///< nodes moved to the middle of their edge (face, cell)
  double farthest = 0;  ///< longest way of a node [m]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< new place of that node
  double volume_change = 0;                         ///< of the body, relative
};

/// Moves the mid-side nodes of every second-order element whose Jacobian is not positive (of tetrahedra: not provably
/// anywhere; of others: not at the places of checked_determinants) to the middles of their edges, those inside the
/// faces and cells of hex27 to the means of the vertices, until no such element is left. Neighbours share the nodes: an
/// element that becomes invalid by the move is straightened in turn. The process ends because straight elements are
/// valid.
/// @param mesh  its straight elements must have positive volume (check_elements); elements of order 1 are left alone
Straightening straighten_elements(Mesh& mesh);

}  // namespace bielle::reduce
