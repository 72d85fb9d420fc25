// A superelement as a set of matrices: interfaces are nodes, modes are scalars, the recovery of displacements is the
// shapes of the points of its mesh.
#pragma once

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// @returns the set, with interface k as node k + 1
MatrixSet matrix_set_of(const Superelement& body);

}  // namespace bielle::reduce
