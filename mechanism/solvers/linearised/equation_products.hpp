// Products with D(s), the linearised equations at s: rows of the motion, then those of the constraints (equations.hpp).
#pragma once

#include <complex>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

/// Products D(s) q, D(s)^T q, and D'(s) q. @param q  (n + constraints)
Eigen::VectorXcd equations_times(const LinearisedEquations& equations, std::complex<double> s,
                                 const Eigen::VectorXcd& q);
Eigen::VectorXcd transposed_equations_times(const LinearisedEquations& equations, std::complex<double> s,
                                            const Eigen::VectorXcd& q);
Eigen::VectorXcd equations_derivative_times(const LinearisedEquations& equations, std::complex<double> s,
                                            const Eigen::VectorXcd& q);
/// Returns (D(sigma) - D(0)) u with the rows of the constraints: the effect of inertia, damping and rolling at a real
/// rate.
/// @param u  (n); the multipliers are zero
VectorX resistance_times(const LinearisedEquations& equations, double sigma, const VectorX& u);

}  // namespace bielle::mechanism
