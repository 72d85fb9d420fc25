// Strain-like quantities of several fields at points of one cell, as a product of dense matrices. Internal to
// reduce/fe.
//
// A field of displacements has A eps(x_p) = B u with u the 3 N displacements of the cell's nodes. B does not depend on
// the field, and a product with the displacements of all fields is the fastest operation of a processor.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "reduce/dense/blas.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Memory for the matrix B of a cell with N nodes and the displacements to which it is applied; one object for each
/// thread.
template <int N>
class CellFields {
 public:
  /// @param points  largest number in a cell; @param fields  largest number at a time
  CellFields(Eigen::Index points, Eigen::Index fields)
      : transposed_(3 * N, 6 * points), displacements_(fields, 3 * N) {}

  /// A eps at point p of the cell, A (6,6). @param gradients  gradients of the shape functions at that point
  void set_point(Eigen::Index p, const Eigen::Matrix<double, 6, 6>& A, const Eigen::Matrix<double, N, 3>& gradients) {
    for (int s = 0; s < 6; ++s) {
      auto column = transposed_.col(6 * p + s);
      for (int i = 0; i < 3; ++i) {
        const Eigen::Matrix<double, N, 1> row =
            gradients * Eigen::Vector3d(A(s, voigt(i, 0)), A(s, voigt(i, 1)), A(s, voigt(i, 2)));
        for (int a = 0; a < N; ++a) column(3 * a + i) = row(a);
      }
    }
  }

  /// Sets A eps at point p from the strains by displacements, (6, 3 N), in place of the gradients.
  void set_strain(Eigen::Index p, const Eigen::Matrix<double, 6, 6>& A, const Eigen::Matrix<double, 6, 3 * N>& strain) {
    transposed_.template middleCols<6>(6 * p).noalias() = strain.transpose() * A.transpose();
  }

  /// Takes columns `first`, `first` + 1, ... of the fields, up to the capacity.
  void take(const RowMatrix& fields, const Eigen::MatrixXi& nodes, Eigen::Index cell, Eigen::Index first = 0) {
    const Eigen::Index width = displacements_.rows();
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < 3; ++i)
        std::copy_n(&fields.coeffRef(3 * static_cast<Eigen::Index>(nodes(a, cell)) + i, first), width,
                    &displacements_.coeffRef(0, 3 * a + i));
  }

  /// Writes (fields, 6 points): component s at point p in column 6 p + s, one column after the other.
  void evaluate(Eigen::Index points, double* result) const {
    const Eigen::Index width = displacements_.rows();
    std::fill_n(result, width * 6 * points, 0.0);
    add_dense_product({displacements_.data(), width, 3 * N, width, false},
                      {transposed_.data(), 3 * N, 6 * points, 3 * N, false}, result, width);
  }

 private:
  Eigen::Matrix<double, 3 * N, Eigen::Dynamic> transposed_;  // B^T, by columns as it is multiplied fastest
  Eigen::Matrix<double, Eigen::Dynamic, 3 * N> displacements_;
};

}  // namespace bielle::reduce
