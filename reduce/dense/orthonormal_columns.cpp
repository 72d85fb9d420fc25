#include "reduce/dense/orthonormal_columns.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

// OpenBLAS contains LAPACK but has no C header for it.
extern "C" {
void dgeqp3_(const int* m, const int* n, double* a, const int* lda, int* pivots, double* tau, double* work,
             const int* lwork, int* info);
void zgeqp3_(const int* m, const int* n, std::complex<double>* a, const int* lda, int* pivots,
             std::complex<double>* tau, std::complex<double>* work, const int* lwork, double* rwork, int* info);
void dorgqr_(const int* m, const int* n, const int* k, double* a, const int* lda, const double* tau, double* work,
             const int* lwork, int* info);
void zungqr_(const int* m, const int* n, const int* k, std::complex<double>* a, const int* lda,
             const std::complex<double>* tau, std::complex<double>* work, const int* lwork, int* info);
}

namespace bielle {

namespace {

using Complex = std::complex<double>;

/// A matrix as LAPACK sees it.
template <class Scalar>
struct Columns {
  int rows, columns, stride;
  Scalar* entries;
};

void factorise(const Columns<double>& A, int* pivots, double* tau, double* work, int room) {
  int info = 0;
  dgeqp3_(&A.rows, &A.columns, A.entries, &A.stride, pivots, tau, work, &room, &info);
}

void factorise(const Columns<Complex>& A, int* pivots, Complex* tau, Complex* work, int room) {
  int info = 0;
  std::vector<double> real_work(2 * static_cast<std::size_t>(A.columns));
  zgeqp3_(&A.rows, &A.columns, A.entries, &A.stride, pivots, tau, work, &room, real_work.data(), &info);
}

void write_factor(const Columns<double>& A, const double* tau, double* work, int room) {
  int info = 0;
  dorgqr_(&A.rows, &A.columns, &A.columns, A.entries, &A.stride, tau, work, &room, &info);
}

void write_factor(const Columns<Complex>& A, const Complex* tau, Complex* work, int room) {
  int info = 0;
  zungqr_(&A.rows, &A.columns, &A.columns, A.entries, &A.stride, tau, work, &room, &info);
}

template <class Matrix>
Matrix orthonormal(Matrix A) {
  using Scalar = typename Matrix::Scalar;
  const Eigen::Index least = std::min(A.rows(), A.cols());
  if (least == 0) return Matrix(A.rows(), 0);
  Columns<Scalar> columns{static_cast<int>(A.rows()), static_cast<int>(A.cols()), static_cast<int>(A.rows()), A.data()};
  std::vector<int> pivots(static_cast<std::size_t>(A.cols()), 0);  // zero: the column may be exchanged
  std::vector<Scalar> tau(static_cast<std::size_t>(least));
  constexpr int block = 32;  // columns at a time
  std::vector<Scalar> work(static_cast<std::size_t>((A.cols() + 2) * (block + 1)));
  const auto room = static_cast<int>(work.size());
  factorise(columns, pivots.data(), tau.data(), work.data(), room);
  const double negligible = std::abs(A(0, 0)) * static_cast<double>(least) * std::numeric_limits<double>::epsilon();
  columns.columns = 0;
  for (Eigen::Index k = 0; k < least; ++k)
    if (std::abs(A(k, k)) > negligible) ++columns.columns;
  A.conservativeResize(Eigen::NoChange, columns.columns);  // a matrix of stored columns keeps the first ones
  columns.entries = A.data();
  write_factor(columns, tau.data(), work.data(), room);
  return A;
}

}  // namespace

Eigen::MatrixXd orthonormal_columns(Eigen::MatrixXd A) { return orthonormal(std::move(A)); }

Eigen::MatrixXcd orthonormal_columns(Eigen::MatrixXcd A) { return orthonormal(std::move(A)); }

}  // namespace bielle
