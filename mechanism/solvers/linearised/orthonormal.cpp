#include "mechanism/solvers/linearised/orthonormal.hpp"

#include <algorithm>

#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::mechanism {

MatrixX orthonormal_columns(const MatrixX& vectors) {
  constexpr double repeated = 1e-13;
  MatrixX basis(vectors.rows(), vectors.cols());
  Eigen::Index found = 0;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    const double size = vectors.col(k).norm();
    if (!(size > 0)) continue;
    VectorX x = vectors.col(k) / size;
    for (int twice = 0; twice < 2; ++twice) {
      const VectorX parts = basis.leftCols(found).transpose() * x;
      x -= basis.leftCols(found) * parts;
    }
    if (x.norm() > repeated) basis.col(found++) = x.normalized();
  }
  return basis.leftCols(found);
}

MatrixX leading_directions(const MatrixX& vectors, Eigen::Index count) {
  if (vectors.cols() == 0) return vectors;
  const SymmetricEigenpairs lengths = symmetric_eigenpairs(MatrixX(vectors.transpose() * vectors));
  constexpr double repeated = 1e-14;  // squared
  MatrixX chosen(vectors.rows(), std::min(count, vectors.cols()));
  Eigen::Index kept = 0;
  for (Eigen::Index k = vectors.cols(); k-- > 0 && kept < chosen.cols();)
    if (lengths.values[k] > repeated * lengths.values[vectors.cols() - 1])
      chosen.col(kept++) = vectors * lengths.vectors.col(k);
  return orthonormal_columns(MatrixX(chosen.leftCols(kept)));
}

}  // namespace bielle::mechanism
