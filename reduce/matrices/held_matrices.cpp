#include "reduce/matrices/held_matrices.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/matrices/set_algebra.hpp"

namespace bielle::reduce {

namespace {

/// Returns G: stiffnesses of the size of the largest one of the unknowns that a condition concerns.
Eigen::VectorXd condition_stiffness(const SparseColumns& conditions, const Eigen::VectorXd& diagonal) {
  Eigen::VectorXd result(conditions.cols());
  for (Eigen::Index k = 0; k < conditions.cols(); ++k) {
    double largest = 0, squares = 0;
    for (SparseColumns::InnerIterator entry(conditions, k); entry; ++entry) {
      largest = std::max(largest, diagonal(entry.row()));
      squares += entry.value() * entry.value();
    }
    result(k) = largest / squares;
  }
  return result;
}

}  // namespace

HeldMatrices::HeldMatrices(const MatrixSet& set, const NodeTies& ties, int threads)
    : set_(set), ties_(ties), mass_(ties.inside.transpose() * set.mass * ties.inside) {
  if (size() > 0) factorise(threads);
}

void HeldMatrices::factorise(int threads) {
  SparseColumns stiffness = ties_.inside.transpose() * set_.stiffness * ties_.inside;
  const SparseColumns conditions = ties_.inside.transpose() * ties_.spread;
  if (conditions.cols() > 0) {
    const Eigen::VectorXd added = condition_stiffness(conditions, stiffness.diagonal());
    stiffness += SparseColumns(conditions * added.asDiagonal() * conditions.transpose());
  }
  try {
    factor_ = definite_factor(stiffness, threads);
  } catch (const NotPositiveDefinite& error) {
    const auto at = static_cast<std::size_t>(error.unknown());
    const Eigen::Index unknown = at < ties_.inner.size() ? ties_.inner[at] : -1;
    throw ComputationError(fmt::format(
        "the stiffness is singular at {}: with its interfaces held the body can still move there; an interface lacks a "
        "direction that holds it, or the matrices leave a part without stiffness",
        unknown >= 0 ? set_.name_of(unknown) : "a direction that an interface releases"));
  }
  if (conditions.cols() == 0) return;
  conditions_ = Eigen::MatrixXd(conditions);
  answers_ = factor_->solve(conditions_);
  // Translations and rotations are scaled to comparable entries before the inversion.
  const Eigen::MatrixXd compliance = transposed_product(conditions_, answers_);
  const Eigen::VectorXd scale = compliance.diagonal().cwiseSqrt().cwiseInverse();
  const auto inverse = regular_inverse(scale.asDiagonal() * compliance * scale.asDiagonal());
  if (!inverse) throw ComputationError("the average ties of the body depend on each other");
  multipliers_ = scale.asDiagonal() * *inverse * scale.asDiagonal();
}

Eigen::MatrixXd HeldMatrices::solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages) const {
  if (!factor_) return f;
  Eigen::MatrixXd z = factor_->solve(f);
  if (conditions_.cols() == 0) return z;
  Eigen::MatrixXd missing = transposed_product(conditions_, z);
  if (averages.size() > 0) missing -= averages;
  return z - product(answers_, product(multipliers_, missing));
}

Eigen::MatrixXd HeldMatrices::inertia(const Eigen::MatrixXd& z) const { return mass_ * z; }

}  // namespace bielle::reduce
