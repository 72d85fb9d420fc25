#include "reduce/dense/dense_products.hpp"

#include <algorithm>

#include <cblas.h>

namespace bielle {
namespace {

/// Below this number of multiplications the overhead of a BLAS call exceeds the gain of its faster kernels, as measured
/// (performance_mechanism_superelements).
constexpr Eigen::Index few = 500;

int integer(Eigen::Index k) { return static_cast<int>(k); }
int stride(const ConstMatrixRef& A) { return std::max(1, integer(A.outerStride())); }

/// Computes C += scale A B, or C += scale A^T B.
void add_by_blas(MatrixRef C, CBLAS_TRANSPOSE order, const ConstMatrixRef& A, const ConstMatrixRef& B, double scale) {
  if (B.cols() == 1)
    cblas_dgemv(CblasColMajor, order, integer(A.rows()), integer(A.cols()), scale, A.data(), stride(A), B.data(), 1, 1,
                C.data(), 1);
  else
    cblas_dgemm(CblasColMajor, order, CblasNoTrans, integer(C.rows()), integer(C.cols()), integer(B.rows()), scale,
                A.data(), stride(A), B.data(), stride(B), 1, C.data(), stride(C));
}

}  // namespace

void add_product(MatrixRef C, const ConstMatrixRef& A, const ConstMatrixRef& B, double scale) {
  if (A.rows() * A.cols() * B.cols() < few)
    C.noalias() += scale * A * B;
  else
    add_by_blas(C, CblasNoTrans, A, B, scale);
}

void add_transposed_product(MatrixRef C, const ConstMatrixRef& A, const ConstMatrixRef& B, double scale) {
  if (A.rows() * A.cols() * B.cols() < few)
    C.noalias() += scale * A.transpose() * B;
  else
    add_by_blas(C, CblasTrans, A, B, scale);
}

void add_weighted(MatrixRef X, std::span<const WeightedMatrix> terms) {
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (const auto& [matrix, weight] : terms) X.col(j) += weight * matrix->col(j);
}

Eigen::MatrixXd product(const ConstMatrixRef& A, const ConstMatrixRef& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.rows(), B.cols());
  add_product(C, A, B);
  return C;
}

Eigen::MatrixXd transposed_product(const ConstMatrixRef& A, const ConstMatrixRef& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.cols(), B.cols());
  add_transposed_product(C, A, B);
  return C;
}

Eigen::MatrixXd congruent(const ConstMatrixRef& S, const ConstMatrixRef& P) {
  return transposed_product(P, product(S, P));
}

}  // namespace bielle
