// Products of dense matrices, compiled once: Eigen compiles a product for each combination of types anew, which takes
// longer than anything else in sources with many products. Large products run in BLAS, whose kernels are optimised for
// the processor; small ones in Eigen. Functions that add to a matrix do not allocate.
#pragma once

#include <span>

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// C += scale A B
void add_product(MatrixRef C, const ConstMatrixRef& A, const ConstMatrixRef& B, double scale = 1);

/// C += scale A^T B
void add_transposed_product(MatrixRef C, const ConstMatrixRef& A, const ConstMatrixRef& B, double scale = 1);

struct WeightedMatrix {
  const Eigen::MatrixXd* matrix;
  double weight;
};

/// X += sum of weight times matrix, all of X's size. X is read and written once.
void add_weighted(MatrixRef X, std::span<const WeightedMatrix> terms);

/// A B
Eigen::MatrixXd product(const ConstMatrixRef& A, const ConstMatrixRef& B);

/// A^T B
Eigen::MatrixXd transposed_product(const ConstMatrixRef& A, const ConstMatrixRef& B);

/// P^T S P
Eigen::MatrixXd congruent(const ConstMatrixRef& S, const ConstMatrixRef& P);

}  // namespace bielle
