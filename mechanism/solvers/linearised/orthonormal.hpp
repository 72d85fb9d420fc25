// Orthonormal bases of vectors that may be linearly dependent.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Returns an orthonormal basis of the same span, by Gram-Schmidt applied twice; rounding errors of dependent columns
/// are omitted.
MatrixX orthonormal_columns(const MatrixX& vectors);

/// Returns an orthonormal basis of at most `count` directions in which vectors are longest; dependent ones are omitted.
MatrixX leading_directions(const MatrixX& vectors, Eigen::Index count);

}  // namespace bielle::mechanism
