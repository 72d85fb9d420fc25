// The BLAS that the factorisations use: its threads, products of dense matrices, and a check that it runs the best
// kernels for this processor.
#pragma once

#include <string>

#include <Eigen/Core>

namespace bielle {

/// Sets the number of OpenBLAS threads while it lives. OpenBLAS threads spin while they wait, so they are never left
/// enabled while Bielle's own threads run.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int before_;
};

/// Makes OpenBLAS's threads and as many OpenMP threads call BLAS once if the address space is limited (ulimit -v): each
/// gets the buffer that OpenBLAS keeps for it. Later OpenBLAS would retry forever if there were not enough memory left.
/// @throws std::bad_alloc when there is not enough
void start_blas(int threads);

/// A dense matrix somewhere in memory: its columns (rows if `row_major`) are `stride` numbers apart.
struct DenseBlock {
  const double* data;
  Eigen::Index rows, columns, stride;
  bool row_major;
};

/// C += A B by dgemm, C stored by columns that are `stride` apart. The function does nothing if a dimension is zero.
void add_dense_product(const DenseBlock& a, const DenseBlock& b, double* c, Eigen::Index stride);

/// A B by dgemm.
Eigen::MatrixXd dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

/// Version and kernels, e.g. "OpenBLAS 0.3.21, kernels for SkylakeX".
std::string blas_description();

/// Returns a sentence if OpenBLAS runs slower kernels than this processor offers (because of OPENBLAS_CORETYPE, or
/// because this OpenBLAS does not know the processor); otherwise empty.
std::string blas_warning();

/// Speed of a product of two square matrices [GFLOP/s], the best of `repeats`.
double measure_dgemm(int size, int threads, int repeats = 3);

}  // namespace bielle
