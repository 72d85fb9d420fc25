// Motion of the line of a beam and of its section at a point, as variables of formulas, with their derivatives.
//
// With the velocity v(z) of the line, the section S(z) and the shares W_k of span_load.hpp, over the increments of both
// nodes,
//     dv = sum of N_k dv_k - R_k (Omega_k x a_k)~ dTheta_k - R_k a_k~ dOmega_k
//     u = S^T v,   du = S^T dv + u~ dTheta(z),   dTheta(z) = sum of W_k R_Sk^T dTheta_k.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mechanism/elements/beam/span_load.hpp"

namespace bielle::mechanism {

/// Variables of a formula along a beam, in the order of `span_variables`.
enum SpanVariable : std::size_t {
  span_place,                   ///< s: 0 to 1 along the beam
  span_time,                    ///< t [s]
  span_v,                       ///< vx, vy, vz: velocity of the line, inertial components [m/s]
  span_section_v = span_v + 3,  ///< section_vx, section_vy, section_vz: the same along the section's axes [m/s]
  span_variable_count = span_section_v + 3
};
const std::vector<std::string>& span_variables();

using SpanValues = std::array<double, span_variable_count>;
SpanValues span_values(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const LocalState& state);

/// Derivatives of these variables by the positions and by the velocities of the two nodes, a row each; zero for s and
/// t.
struct SpanGradients {
  Eigen::Matrix<double, span_variable_count, 12> by_position, by_rate;
};
SpanGradients span_gradients(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                             const LocalState& state);

}  // namespace bielle::mechanism
