// Products of matrices with many rows and few columns, such as blocks of vectors. Each thread takes a range of rows and
// one BLAS thread, so that threads neither spin nor wait for each other.
#pragma once

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// A^T B, A and B having the same rows. The result does not vary between runs with the same number of threads.
Eigen::MatrixXd tall_inner_products(const ConstMatrixRef& A, const ConstMatrixRef& B, int threads);

/// Y += scale A C, where Y and A have the same rows.
void add_tall_product(MatrixRef Y, const ConstMatrixRef& A, const Eigen::MatrixXd& C, double scale, int threads);

/// The first columns of A become A C, where C has at most as many columns as rows; no second A is needed.
void combine_columns(MatrixRef A, const Eigen::MatrixXd& C, int threads);

}  // namespace bielle
