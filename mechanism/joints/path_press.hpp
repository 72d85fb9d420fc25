// Normal force of a point that slides along a path c(u) whose parameter is an unknown of the joint.
//
// In the equation of u, the part of the reaction along the path balances friction. The normal force is the remaining
// part:
//     F_n = F - t (t . F),   t = c'/|c'|,     dF_n = (I - t t^T) dF - [(t . F) I + t F^T] dt,
//     dt = (I - t t^T) dc'/|c'|.
// Moments contribute unchanged.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Removes the part along the path from a reaction. @param along  c', in the axes of the reaction
Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along);

/// Removes this part, with derivatives. @param derivatives  derivatives of the reaction on entry, and of the result on
/// return (6, n)
/// @param by_position  derivatives of c' (3, n)
Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along,
                            const Eigen::Matrix<double, 3, Eigen::Dynamic>& by_position, MatrixX& derivatives);

}  // namespace bielle::mechanism
