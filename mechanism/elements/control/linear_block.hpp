// Linear blocks of controllers in state space:   x' = A x + B u,   y = C x + D u.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

struct LinearBlock {
  MatrixX A;  ///< (n, n) [1/s]
  MatrixX B;  ///< (n, inputs)
  MatrixX C;  ///< (outputs, n)
  MatrixX D;  ///< (outputs, inputs): direct feed-through
};

/// x' = u: the user's own differential equation, u its right side. Output x.
LinearBlock integrator();
/// y' = (u - y)/T. @param time_constant  T > 0 [s]
LinearBlock first_order_filter(double time_constant);
/// The same with T = 0: y = u. Its one state follows by itself, and nothing reads it.
LinearBlock no_filter();
/// y'' + 2 d w y' + w^2 y = w^2 u, w = 2 pi frequency. States y, y'/w; outputs y, y'.
/// @param frequency  > 0 [Hz] @param damping  d >= 0 [-]
LinearBlock second_order_filter(double frequency, double damping);

/// y = b(s)/a(s) u, coefficients in descending powers of s; the first of `denominator` is not zero, and there are no
/// more in `numerator`. Controllable canonical form with time counted in 1/w_0, w_0 the geometric mean of the poles
/// that are not zero, so that states are of the input's size whatever the poles are:
///     x_i' = w_0 x_(i+1),   x_n' = w_0 (u/g - sum alpha_i x_i),   y = sum beta_i x_i + d u,
/// with alpha the coefficients of a(w_0 sigma), made monic. Reference: T. Kailath, Linear Systems, 1980, 2.1.
LinearBlock realisation(const std::vector<double>& numerator, const std::vector<double>& denominator);

/// G of x = G u, where all rates are zero; nothing where A is singular (an integrator).
std::optional<MatrixX> rest_of(const LinearBlock& block);

}  // namespace bielle::mechanism
