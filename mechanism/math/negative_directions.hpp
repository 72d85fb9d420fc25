// How many eigenvalues of a symmetric matrix K are negative on the null space of another, B: by Sylvester's law as many
// as those of
//     [ K + c B^T B   B^T ]
//     [ B             -d  ]
// less one for each row of B (the Schur complement of the lower block is K + (c + 1/d) B^T B). The number is read off
// the pivots of a symmetric factorisation. c = 100 relative to what is next to a row lets unknowns be eliminated first
// that resist nothing themselves; d = 1e-12 is there for rows that repeat each other. With c alone rows would give, and
// a direction without stiffness of its own that is coupled with one that gives would pass for negative. A direction
// softer than 1e-15 is taken for indifferent: its sign is rounding. The sign of a determinant would miss two
// eigenvalues that change sign together, as of a square column.
//
// Unknowns have units. They come in groups of one unit (translations of a node, its turns), and each group has a size,
// of the unit of its diagonal entries: nothing else is compared with each other, so that no unit decides.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Sizes (n) > 0 of the diagonal entries: the largest of the unknown's group. A group without any (a rigid body resists
/// no displacement itself) has what its coupling K_ij^2/s_j to others amounts to, or else what it meets behind its rows
/// of B, or else 1.
/// @param group  of each unknown, ascending from 0
VectorX group_sizes(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& B,
                    const std::vector<int>& group);

/// @param K      both triangles (n, n)
/// @param B      (any, n); rows may repeat each other
/// @param sizes  see group_sizes
/// @returns nothing for large matrices in which pivots are so small that rounding decides; small ones are solved for
/// their eigenvalues then
std::optional<int> count_negative_directions(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& B,
                                             const VectorX& sizes);

}  // namespace bielle::mechanism
