// Whether a matrix was positive definite, of which MUMPS made a factor: it goes on where a pivot is tiny or negative.
#pragma once

#include <optional>

#include "reduce/sparse/factor.hpp"

namespace bielle::reduce {

/// Two steps of inverse iteration on S^-1 A S^-1 find the motion that A resists least.
/// @param scale      (size) the diagonal of S: of each unknown, the root of the size of its diagonal entry
/// @param suspected  whether something else shows that A is not positive definite
/// @returns the unknown that moves most, where A is singular to working precision or suspected
std::optional<Eigen::Index> unresisted_unknown(const Factor& factor, const Eigen::VectorXd& scale, bool suspected);

}  // namespace bielle::reduce
