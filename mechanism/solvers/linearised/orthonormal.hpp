// Orthonormal bases of vectors that may repeat each other.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// An orthonormal basis of the same span, by Gram and Schmidt twice; what rounding makes of a repeated column is left
/// out.
MatrixX orthonormal_columns(const MatrixX& vectors);

/// An orthonormal basis of at most `count` directions in which vectors are longest; what repeats others is left out.
MatrixX leading_directions(const MatrixX& vectors, Eigen::Index count);

}  // namespace bielle::mechanism
