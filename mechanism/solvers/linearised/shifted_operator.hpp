// The linearised equations as a shift-inverted operator: T = (A - sigma E)^-1 E of their first-order form A x = s E x,
// whose eigenvalues are 1 / (s - sigma).
//
// States are x = [u; w] (equations.hpp); multipliers follow. The pencil's infinite eigenvalues (constraints, algebraic
// unknowns, directions without mass) become zeros of T: what T yields has no part of them after three applications.
// One sparse factorisation of the size of the equations of motion serves: with a = (sigma + W) u + u_in,
//     [(sigma M + C)(sigma + W) + K] u + (B^T + F) lambda = -(sigma M + C) u_in - M w_in,
//     B u = 0,   B a + S u = 0  (non-holonomic),        w = a of the dofs.
// A complex shift doubles the real equations. States are scaled: so that M has a diagonal of ones, rates by the shift,
// first-order unknowns so that they answer to motions as motions answer to them.
#pragma once

#include <complex>
#include <memory>

#include "mechanism/math/sparse.hpp"
#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

class ShiftedOperator {
 public:
  using Complex = std::complex<double>;
  using VectorXc = Eigen::VectorXcd;

  /// Whether `solve` is that of the equations, or of their transpose, which has nothing but `solve`.
  enum class Side { right, left };
  /// @param equations  must outlive this
  ShiftedOperator(const LinearisedEquations& equations, Complex shift, Side side = Side::right);
  ~ShiftedOperator();
  ShiftedOperator(const ShiftedOperator&) = delete;
  ShiftedOperator& operator=(const ShiftedOperator&) = delete;

  /// Whether there are factors: not where the shift is an eigenvalue, or every number is.
  bool regular() const { return regular_; }
  /// Where the factorisation found no pivot: among the unknowns, then the constraints in the equations; or -1.
  int singular() const { return singular_; }
  Complex shift() const { return shift_; }
  bool is_real() const { return shift_.imag() == 0; }

  /// T x of scaled states. @param x (states)
  VectorXc apply(const VectorXc& x) const;
  VectorX apply(const VectorX& x) const;  ///< of a real shift alone
  /// The multipliers that belong to T x, of a real shift alone. @returns (constraints)
  VectorX multipliers(const VectorX& x) const;
  /// [u; lambda] for right-hand sides of the equations of motion and of the constraints (their rows of D).
  VectorXc solve(const VectorXc& right) const;

  /// Physical = scale times scaled.
  const VectorX& scale() const { return scale_; }  ///< (states)

 private:
  using SparseC = Eigen::SparseMatrix<Complex>;
  void build();
  void set_scale(const SparseC& D);
  template <class Vector, class Matrix>
  Vector right_side(const Vector& in, const Matrix& rates) const;
  template <class Vector, class Matrix, class Solve>
  Vector apply_with(const Vector& x, const Matrix& rates, typename Vector::Scalar shift,
                    const Solve& solution_of) const;

  const LinearisedEquations& equations_;
  Complex shift_;
  Side side_;
  bool regular_ = false;
  VectorX scale_;
  SparseC rates_;                           ///< sigma M + C
  Eigen::SparseMatrix<double> real_rates_;  ///< the same of a real shift
  bool any_nonholonomic_ = false;
  int singular_ = -1;
  std::unique_ptr<const SparsePattern> pattern_;
  std::unique_ptr<SparseLU> factors_;
};

}  // namespace bielle::mechanism
