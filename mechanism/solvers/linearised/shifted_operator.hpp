// The linearised equations as a shift-inverted operator: T = (A - sigma E)^-1 E of their first-order form A x = s E x,
// whose eigenvalues are 1 / (s - sigma).
//
// States are x = [u; w] (equations.hpp); multipliers follow from them. The pencil's infinite eigenvalues (constraints,
// algebraic unknowns, directions without mass) become zeros of T: a result of T has no component of them after three
// applications.
// One sparse factorisation of the size of the equations of motion is sufficient: with a = (sigma + W) u + u_in,
//     [(sigma M + C)(sigma + W) + K] u + (B^T + F) lambda = -(sigma M + C) u_in - M w_in,
//     B u = 0,   B a + S u = 0  (non-holonomic),        w = a of the dofs.
// States are scaled: such that M has a diagonal of ones, rates by the shift, first-order unknowns such that they
// respond to motions as motions respond to them.
#pragma once

#include <complex>
#include <memory>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

class ShiftedOperator {
 public:
  using Complex = std::complex<double>;
  using VectorXc = Eigen::VectorXcd;

  /// Whether `solve` uses the equations or their transpose; the transpose only supports `solve`.
  enum class Side { right, left };
  /// @param equations  must outlive this object
  ShiftedOperator(const LinearisedEquations& equations, Complex shift, Side side = Side::right);
  /// Takes over the sequence of pivots of another operator if its matrix has the same pattern, which saves most of the
  /// factorisation. The solutions may be less accurate. @param other  ends; none: pivots are chosen
  ShiftedOperator(const LinearisedEquations& equations, Complex shift, std::unique_ptr<ShiftedOperator> other);
  ~ShiftedOperator();
  ShiftedOperator(const ShiftedOperator&) = delete;
  ShiftedOperator& operator=(const ShiftedOperator&) = delete;

  /// Whether the factorisation succeeded: not if the shift is an eigenvalue, or every number is.
  bool regular() const { return regular_; }
  /// Index at which the factorisation found no pivot: among the unknowns, then the active constraints; or -1.
  int singular() const { return singular_; }
  Complex shift() const { return shift_; }
  bool is_real() const { return shift_.imag() == 0; }

  /// Returns T x for scaled states. @param x (states)
  VectorXc apply(const VectorXc& x) const;
  VectorX apply(const VectorX& x) const;  ///< only for a real shift
  /// Returns the multipliers that belong to T x, only for a real shift. @returns (constraints)
  VectorX multipliers(const VectorX& x) const;
  /// Returns [u; lambda] for right-hand sides of the equations of motion and of the constraints (their rows of D).
  VectorXc solve(const VectorXc& right) const;

  /// Returns the factors by which scaled values become physical ones.
  const VectorX& scale() const { return scale_; }  ///< (states)
  /// Returns such factors of the unknowns u and of the multipliers. (unknowns + constraints)
  const VectorX& scale_of_solutions() const { return scale_of_solutions_; }

 private:
  using SparseC = Eigen::SparseMatrix<Complex>;
  void build(ShiftedOperator* other);
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
  VectorX scale_, scale_of_solutions_;
  SparseC rates_;                           ///< sigma M + C
  Eigen::SparseMatrix<double> real_rates_;  ///< sigma M + C, for a real shift
  bool any_nonholonomic_ = false;
  int singular_ = -1;
  std::unique_ptr<const SparsePattern> pattern_;
  std::unique_ptr<SparseLU> factors_;  ///< for a real shift
  std::unique_ptr<ComplexSparseLU> complex_factors_;
};

}  // namespace bielle::mechanism
