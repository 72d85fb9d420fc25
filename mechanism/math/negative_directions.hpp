// Counts the eigenvalues of a symmetric matrix K that are negative on the null space of another matrix B. By
// Sylvester's law their number is that of
//     [ K + c B^T B   B^T ]
//     [ B             -d  ]
// minus one for each row of B (the Schur complement of the lower block is K + (c + 1/d) B^T B). The number is read from
// the pivots of a symmetric factorisation. The value c = 100, relative to the groups next to a row, allows unknowns
// without stiffness of their own to be eliminated first; d = 1e-12 is necessary for redundant rows. With c alone the
// rows would be elastic, and a direction without stiffness of its own that is coupled with an elastic direction would
// be counted as negative. A direction with a stiffness below 1e-15 is considered indifferent: its sign is determined by
// rounding. The sign of a determinant would miss two eigenvalues that change sign together, for example of a square
// column.
//
// Unknowns have units. They form groups of one unit (translations of a node, its rotations), and each group has a size,
// in the unit of its diagonal entries: entries are only compared after division by these sizes, so that the result does
// not depend on units.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Returns the sizes (n) > 0 of the diagonal entries: the largest in the unknown's group. A group without diagonal
/// entries (a rigid body has no stiffness itself) takes its size from its coupling K_ij^2/s_j to other groups,
/// otherwise from the groups that rows of B couple it to, otherwise 1.
/// @param group  group of each unknown, from 0, that of the last unknown being the largest; empty: every unknown is a
/// group of its own
VectorX group_sizes(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& B,
                    const std::vector<int>& group);

/// @param K      both triangles (n, n)
/// @param B      (any, n); rows may be redundant
/// @param sizes  see group_sizes
/// @returns no value for large matrices with pivots so small that rounding decides; small matrices are then solved for
/// their eigenvalues
std::optional<int> count_negative_directions(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& B,
                                             const VectorX& sizes);

}  // namespace bielle::mechanism
