// Symmetry of D(s), which determines whether left vectors follow from right ones.
#pragma once

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

enum class EquationSymmetry {
  symmetric,   ///< D = D^T: left vectors equal right ones
  gyroscopic,  ///< D(s)^T = D(-s): on the imaginary axis, left vectors are conjugates
  none
};

/// Returns D(0) = K + C W, and the factor of s in D(s) = M s^2 + (C + M W) s + D(0).
LinearisedEquations::Sparse stiffness_in_axes(const LinearisedEquations& equations);
LinearisedEquations::Sparse damping_in_axes(const LinearisedEquations& equations);
/// Whether D(0) is symmetric, and holonomic constraints are the only ones.
bool has_symmetric_stiffness(const LinearisedEquations& equations);

EquationSymmetry equation_symmetry(const LinearisedEquations& equations);

/// Computes a left vector y (n + constraints) of an eigenvalue that pairs with a right one, y^T D(s) = 0, by inverse
/// iteration with the transposed equations next to s: one factorisation. Its size is 0 if there is none.
Eigen::VectorXcd left_vector(const LinearisedEquations& equations, std::complex<double> s, const Eigen::VectorXcd& u);

}  // namespace bielle::mechanism
