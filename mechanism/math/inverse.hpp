// Inverses of small matrices, compiled once.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// A^-1 by LU factorisation with partial pivoting; not finite where A is singular.
Matrix6 inverse(const Matrix6& A);

/// A^-1 of a symmetric positive definite matrix, exactly symmetric.
Matrix6 symmetric_inverse(const Matrix6& A);

}  // namespace bielle::mechanism
