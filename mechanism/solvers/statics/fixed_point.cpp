#include "mechanism/solvers/statics/fixed_point.hpp"

#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {

VectorX FixedPoint::next(const VectorX& x, const VectorX& image) {
  constexpr std::size_t depth = 6;
  const VectorX g = image - x;
  if (g_.size() > 0) {
    dx_.push_back(x - x_);
    dg_.push_back(g - g_);
    if (dx_.size() > depth) {
      dx_.erase(dx_.begin());
      dg_.erase(dg_.begin());
    }
  }
  x_ = x;
  g_ = g;
  const auto count = static_cast<Eigen::Index>(dg_.size());
  VectorX next = image;
  if (count == 0) return next;
  MatrixX A(count, count), b(count, 1);
  const VectorX squares = weights_.cwiseAbs2();
  for (Eigen::Index i = 0; i < count; ++i) {
    const VectorX weighted = squares.cwiseProduct(dg_[static_cast<std::size_t>(i)]);
    b(i, 0) = weighted.dot(g);
    for (Eigen::Index j = 0; j < count; ++j) A(i, j) = weighted.dot(dg_[static_cast<std::size_t>(j)]);
  }
  // If steps are linearly dependent, this term makes c unique.
  A.diagonal() *= 1 + 1e-12;
  if (!(A.diagonal().minCoeff() > 0)) return next;
  const MatrixX c = solve_symmetric(A, b);
  if (!c.allFinite()) return next;
  for (Eigen::Index i = 0; i < count; ++i)
    next -= c(i, 0) * (dx_[static_cast<std::size_t>(i)] + dg_[static_cast<std::size_t>(i)]);
  return next;
}

}  // namespace bielle::mechanism
