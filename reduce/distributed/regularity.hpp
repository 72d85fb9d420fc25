// A check that a matrix that MUMPS has factorised was positive definite: MUMPS does not stop at a tiny or negative
// pivot.
#pragma once

#include <optional>

#include "reduce/sparse/factor.hpp"

namespace bielle::reduce {

/// Finds the motion that A resists least by two steps of inverse iteration on S^-1 A S^-1.
/// @param scale      (size) the diagonal of S: for each unknown, the root of the absolute value of its diagonal entry
/// @param suspected  whether there is other evidence that A is not positive definite
/// @returns the unknown that moves most, if A is singular to working precision or suspected
std::optional<Eigen::Index> unresisted_unknown(const Factor& factor, const Eigen::VectorXd& scale, bool suspected);

}  // namespace bielle::reduce
