// Products of matrices with many rows and few columns: blocks of vectors against each other. Each thread takes a range
// of rows, with one BLAS thread, so that they neither spin nor wait for each other's columns.
#pragma once

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// A^T B, A and B having the same rows. The same for the same number of threads.
Eigen::MatrixXd tall_inner_products(const ConstMatrixRef& A, const ConstMatrixRef& B, int threads);

/// Y += scale A C, of the rows of A.
void add_tall_product(MatrixRef Y, const ConstMatrixRef& A, const Eigen::MatrixXd& C, double scale, int threads);

/// The first columns of A become A C, C having no more columns than rows; no second A is needed.
void combine_columns(MatrixRef A, const Eigen::MatrixXd& C, int threads);

}  // namespace bielle
