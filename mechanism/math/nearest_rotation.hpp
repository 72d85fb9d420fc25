// Matrices that are rotations but for rounding: how far off they are, and the rotation nearest to them.
#pragma once

#include <optional>
#include <string>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Largest entry of A^T A - 1 that rounding of few digits explains; what is farther off is no rotation.
inline constexpr double rotation_margin = 1e-3;

/// Why a matrix is no rotation, as a part of a sentence about its columns; nothing where it is one within the margin.
std::optional<std::string> rotation_fault(const Matrix3& A);

/// Returns the rotation with the smallest sum of squared differences to A. @param A  with a positive determinant
Matrix3 nearest_rotation(const Matrix3& A);

}  // namespace bielle::mechanism
