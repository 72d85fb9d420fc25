// The BLAS below the factorisations: its threads, products of dense matrices, and whether it runs the best kernels for
// this processor.
#pragma once

#include <string>

#include <Eigen/Core>

namespace bielle {

/// Sets the number of OpenBLAS threads while it lives. OpenBLAS threads spin, so they are never left on while threads
/// of our own run.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int before_;
};

/// Has OpenBLAS's threads and as many of OpenMP's call BLAS once where the address space is limited (ulimit -v): each
/// gets the memory that OpenBLAS keeps for it, which it would ask for for ever where there is not enough later.
/// @throws std::bad_alloc when there is not enough
void start_blas(int threads);

/// A dense matrix somewhere in memory: its columns (rows if `row_major`) are `stride` numbers apart.
struct DenseBlock {
  const double* data;
  Eigen::Index rows, columns, stride;
  bool row_major;
};

/// C += A B by dgemm, C stored by columns that are `stride` apart. Nothing happens where a dimension is zero.
void add_dense_product(const DenseBlock& a, const DenseBlock& b, double* c, Eigen::Index stride);

/// A B by dgemm.
Eigen::MatrixXd dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

/// E.g. "OpenBLAS 0.3.21, kernels for SkylakeX".
std::string blas_description();

/// A sentence when OpenBLAS runs slower kernels than this processor offers (forced by OPENBLAS_CORETYPE, or unknown to
/// this OpenBLAS); empty otherwise.
std::string blas_warning();

/// Speed of a product of two square matrices [GFLOP/s], the best of `repeats`.
double measure_dgemm(int size, int threads, int repeats = 3);

}  // namespace bielle
