#include "reduce/dense/dense_solves.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace bielle {

namespace {

/// Computes x <- (L U)^-1 x.
void solve_triangles(const Eigen::MatrixXd& LU, MatrixRef x) {
  if (x.cols() == 1) {
    auto vector = x.col(0);
    LU.triangularView<Eigen::UnitLower>().solveInPlace(vector);
    LU.triangularView<Eigen::Upper>().solveInPlace(vector);
    return;
  }
  LU.triangularView<Eigen::UnitLower>().solveInPlace(x);
  LU.triangularView<Eigen::Upper>().solveInPlace(x);
}

}  // namespace

Eigen::MatrixXd solve_symmetric(const ConstMatrixRef& A, const ConstMatrixRef& B) {
  return Eigen::LDLT<Eigen::MatrixXd>(A).solve(B);
}

std::optional<Eigen::MatrixXd> regular_inverse(const ConstMatrixRef& A) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  if (!lu.isInvertible()) return {};
  return Eigen::MatrixXd(lu.inverse());
}

struct LUFactors::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

LUFactors::LUFactors() : factors_(std::make_unique<Factors>()) {}
LUFactors::LUFactors(LUFactors&&) noexcept = default;
LUFactors& LUFactors::operator=(LUFactors&&) noexcept = default;
LUFactors::~LUFactors() = default;

void LUFactors::compute(const ConstMatrixRef& A) { factors_->lu.compute(A); }

// Eigen's own `solve` allocates where it permutes.
void LUFactors::solve(const ConstMatrixRef& b, MatrixRef x) const {
  const auto& to = factors_->lu.permutationP().indices();
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    for (Eigen::Index i = 0; i < b.rows(); ++i) x(to[i], j) = b(i, j);
  solve_triangles(factors_->lu.matrixLU(), x);
}

void LUFactors::set_inverse(MatrixRef X) const {
  const auto& to = factors_->lu.permutationP().indices();
  X.setZero();
  for (Eigen::Index i = 0; i < to.size(); ++i) X(to[i], i) = 1;
  solve_triangles(factors_->lu.matrixLU(), X);
}

Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>> LUFactors::pivots() const {
  return factors_->lu.matrixLU().diagonal();
}

double LUFactors::determinant() const { return factors_->lu.determinant(); }

int LUFactors::sign() const {
  int sign = factors_->lu.permutationP().determinant() < 0 ? -1 : 1;
  for (const double pivot : pivots())
    if (pivot < 0) sign = -sign;
  return sign;
}

}  // namespace bielle
