// Derivatives of smooth functions by central differences, accurate enough to test exact tangents.
//
// Three central differences with steps h, h/2, h/4 are extrapolated to order h^6 (Richardson). For a function that
// varies on the scale 1 and h = 0.02 the truncation error is below 1e-15 and the rounding error about 3 epsilon / (h/4)
// ~ 1e-13 of the size of the function: tolerances of 1e-11 leave room for sums of many terms.
#pragma once

#include <Eigen/Core>

namespace bielle::test {

inline constexpr double difference_step = 0.02;

/// Returns df/ds at s = 0 of a function of one number with values in an Eigen type (or double).
template <class Function>
auto derivative(const Function& f, double h = difference_step) {
  const auto central = [&](double step) {
    auto d = f(step);
    d -= f(-step);
    d /= 2 * step;
    return d;
  };
  const auto d1 = central(h), d2 = central(h / 2), d4 = central(h / 4);
  auto extrapolated = d1;
  extrapolated = (64 * d4 - 20 * d2 + d1) / 45;
  return extrapolated;
}

/// Returns the Jacobian of a vector function of a vector: column k is the derivative along unit direction k at zero.
template <class Function>
Eigen::MatrixXd jacobian(const Function& f, Eigen::Index columns, double h = difference_step) {
  Eigen::MatrixXd J;
  for (Eigen::Index k = 0; k < columns; ++k) {
    const Eigen::VectorXd d = derivative(
        [&](double s) -> Eigen::VectorXd { return f(Eigen::VectorXd(s * Eigen::VectorXd::Unit(columns, k))); }, h);
    if (k == 0) J.resize(d.size(), columns);
    J.col(k) = d;
  }
  return J;
}

}  // namespace bielle::test
