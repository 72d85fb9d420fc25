// The mean strain of a body: the part of its strain that does not cancel over the volume, as that of bending and twist
// does.
#pragma once

#include "reduce/fe/solid.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Returns the integral of the strain xx yy zz yz xz xy (engineering shears) over the volume, divided by the volume.
/// @param fields  (3 points, k) displacements @returns (6, k)
Eigen::MatrixXd mean_strain(const Solid& solid, const RowMatrix& fields);

}  // namespace bielle::reduce
