// Dense systems of linear equations. Eigen's factorisations are heavy templates: they are compiled here only.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// A^-1 B of a symmetric A that is positive semidefinite, by L D L^T with pivoting.
Eigen::MatrixXd solve_symmetric(const ConstMatrixRef& A, const ConstMatrixRef& B);

/// A^-1 by LU factorisation with full pivoting; nothing if A is singular to rounding.
std::optional<Eigen::MatrixXd> regular_inverse(const ConstMatrixRef& A);

/// P A = L U with partial pivoting. Memory is allocated only if the size changes.
class LUFactors {
 public:
  LUFactors();
  LUFactors(LUFactors&&) noexcept;
  LUFactors& operator=(LUFactors&&) noexcept;
  ~LUFactors();

  void compute(const ConstMatrixRef& A);
  /// x = A^-1 b; they must not share memory.
  void solve(const ConstMatrixRef& b, MatrixRef x) const;
  /// X = A^-1
  void set_inverse(MatrixRef X) const;
  /// Pivots, whose product is the determinant up to its sign.
  Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>> pivots() const;
  double determinant() const;
  /// Sign of the determinant, -1 or 1; the determinant itself may overflow.
  int sign() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace bielle
