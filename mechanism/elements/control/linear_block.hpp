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

/// Returns x' = u: a differential equation of the user with the right-hand side u. The output is x.
LinearBlock integrator();
/// Returns y' = (u - y)/T. @param time_constant  T > 0 [s]
LinearBlock first_order_filter(double time_constant);
/// Returns the filter with T = 0: y = u. Its single state decays by itself, and has no effect on y.
LinearBlock no_filter();
/// Returns y'' + 2 d w y' + w^2 y = w^2 u, w = 2 pi frequency. Its states are y, y'/w; its outputs y, y'.
/// @param frequency  > 0 [Hz] @param damping  d >= 0 [-]
LinearBlock second_order_filter(double frequency, double damping);

/// Returns y = b(s)/a(s) u, with coefficients in descending powers of s; the first of `denominator` is not zero, and
/// `numerator` has at most as many. The realisation is the controllable canonical form with time in units of 1/w_0,
/// where w_0 is the geometric mean of the nonzero poles, so that states have the size of the input for any poles:
///     x_i' = w_0 x_(i+1),   x_n' = w_0 (u/g - sum alpha_i x_i),   y = sum beta_i x_i + d u,
/// Here alpha are the coefficients of a(w_0 sigma), normalised to a leading one. Reference: T. Kailath, Linear Systems,
/// 1980, 2.1.
LinearBlock realisation(const std::vector<double>& numerator, const std::vector<double>& denominator);

/// Returns G of the state at rest, x = G u, in which all rates are zero; no value if A is singular (an integrator).
std::optional<MatrixX> rest_of(const LinearBlock& block);

}  // namespace bielle::mechanism
