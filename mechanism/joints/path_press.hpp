// What presses where a point slides along a path c(u) whose parameter is an unknown of the joint.
//
// The equation of u balances friction by the part of the reaction along the path. What presses is the rest:
//     F_n = F - t (t . F),   t = c'/|c'|,     dF_n = (I - t t^T) dF - [(t . F) I + t F^T] dt,
//     dt = (I - t t^T) dc'/|c'|.
// Moments press as they are.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Takes what is along the path out of a reaction. @param along  c', in the axes of the reaction
Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along);

/// The same of its derivatives. @param derivatives  of the reaction, receives those of the result (6, n)
/// @param by_position  of c' (3, n)
Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along,
                            const Eigen::Matrix<double, 3, Eigen::Dynamic>& by_position, MatrixX& derivatives);

}  // namespace bielle::mechanism
