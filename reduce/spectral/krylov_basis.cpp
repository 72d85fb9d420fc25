#include "reduce/spectral/krylov_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/dense/tall_products.hpp"

namespace bielle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double rounding = 2.2e-16;
/// Factor by which rounding errors may grow before a block is orthogonalised again.
constexpr double harmless = 100;
constexpr int most_passes = 10;
/// Images shorter than this share of the largest |nu| are rounding errors.
constexpr double negligible_image = 1e-14;
/// Bound for random vectors, relative to their length before they were made orthogonal to the basis and each other.
constexpr double negligible_start = 1e-11;

/// Y V D^-1/2 is orthonormal as far as the Gram matrix V D V^T of Y determines it, and Y = (Y V D^-1/2) (D^1/2 V^T).
struct Orthonormalisation {
  MatrixXd transform;    // V D^-1/2
  MatrixXd triangle;     // D^1/2 V^T
  double condition = 0;  // largest over least singular value of Y, as far as it can be told
};

Orthonormalisation orthonormalise(const MatrixXd& gram) {
  const Index width = gram.cols();
  const SymmetricEigenpairs pairs = symmetric_eigenpairs((gram + gram.transpose()) / 2);
  // Smaller values are rounding errors: these directions are scaled up by slightly less and orthogonalised again.
  const double least = static_cast<double>(width) * rounding * pairs.values(width - 1);
  const VectorXd roots = pairs.values.cwiseMax(least).cwiseSqrt();
  return {pairs.vectors * roots.cwiseInverse().asDiagonal(), roots.asDiagonal() * pairs.vectors.transpose(),
          roots(width - 1) / roots(0)};
}

}  // namespace

void KrylovBasis::Block::transform(const MatrixXd& by, int threads) {
  combine_columns(vectors, by, threads);
  combine_columns(mass_vectors, by, threads);
  vectors.conservativeResize(Eigen::NoChange, by.cols());
  mass_vectors.conservativeResize(Eigen::NoChange, by.cols());
}

KrylovBasis::KrylovBasis(const ShiftInvertProblem& problem, Index capacity, int threads,
                         std::function<void(Index)> on_solve)
    : problem_(problem),
      threads_(threads),
      on_solve_(std::move(on_solve)),
      random_(problem.size),
      vectors_(problem.size, capacity),
      projected_(MatrixXd::Zero(capacity, capacity)) {}

MatrixXd KrylovBasis::solve(const MatrixXd& b) {
  MatrixXd x = problem_.solve(b);
  on_solve_(b.cols());
  return x;
}

MatrixXd KrylovBasis::remove_basis(MatrixXd& Y, MatrixXd& mass_y) const {
  const auto Q = vectors_.leftCols(size_);
  MatrixXd amplitudes = tall_inner_products(Q, mass_y, threads_);
  add_tall_product(Y, Q, amplitudes, -1, threads_);
  mass_y = problem_.multiply_mass(Y);
  return amplitudes;
}

void KrylovBasis::set_front(Block block, MatrixXd removed, double negligible) {
  for (int pass = 0; pass < most_passes && block.vectors.cols() > 0; ++pass) {
    const MatrixXd gram = tall_inner_products(block.vectors, block.mass_vectors, threads_);
    if (!(gram.diagonal().maxCoeff() > 0)) {
      block.transform(MatrixXd(block.vectors.cols(), 0), threads_);
      block.coupling.resize(0, Eigen::NoChange);
      break;
    }
    const Orthonormalisation by = orthonormalise(gram);
    block.coupling = by.triangle * block.coupling;
    std::vector<Index> kept;
    for (Index k = block.coupling.rows() - 1; k >= 0; --k)  // the longest first
      if (block.coupling.row(k).norm() > negligible) kept.push_back(k);
    kept.resize(std::min<std::size_t>(kept.size(), static_cast<std::size_t>(problem_.size - size_)));
    block.coupling = MatrixXd(block.coupling(kept, Eigen::all));
    const MatrixXd transform = by.transform(Eigen::all, kept);
    block.transform(transform, threads_);
    // Short directions were scaled up, and so were the remainders of Q and of each other in them.
    const MatrixXd scaled_up = removed * transform;
    if (by.condition < harmless && scaled_up.norm() < harmless) break;
    removed = remove_basis(block.vectors, block.mass_vectors);
  }
  front_ = block.vectors.cols();
  put_front(block.vectors);
  mass_front_ = std::move(block.mass_vectors);
  coupling_of_front_ = std::move(block.coupling);
}

void KrylovBasis::put_front(const MatrixXd& vectors) {
#pragma omp parallel for num_threads(threads_)
  for (Index k = 0; k < vectors.cols(); ++k) vectors_.col(size_ + k) = vectors.col(k);
}

void KrylovBasis::start(Index width) {
  Block block;
  block.vectors = random_.draw(width);
  block.mass_vectors = problem_.multiply_mass(block.vectors);
  if (size_ > 0) remove_basis(block.vectors, block.mass_vectors);
  // The vectors are brought into the range of S M, where M is definite.
  block.vectors = solve(block.mass_vectors);
  block.mass_vectors = problem_.multiply_mass(block.vectors);
  const double length = std::sqrt(block.vectors.cwiseProduct(block.mass_vectors).colwise().sum().maxCoeff());
  if (!(length > 0)) {
    front_ = 0;
    return;
  }
  block.coupling = MatrixXd::Identity(width, width) / length;
  const MatrixXd removed = remove_basis(block.vectors, block.mass_vectors);
  coupled_ = last_ = size_;
  set_front(std::move(block), removed, negligible_start);
}

void KrylovBasis::expand() {
  const Index before = size_, width = front_, coupled = before - coupled_;
  const auto Q = vectors_.middleCols(coupled_, coupled), F = vectors_.middleCols(before, width);
  Block block;
  block.vectors = solve(mass_front_);
  add_tall_product(block.vectors, Q, projected_.block(before, coupled_, width, coupled).transpose(), -1, threads_);
  MatrixXd own = tall_inner_products(mass_front_, block.vectors, threads_);
  add_tall_product(block.vectors, F, own, -1, threads_);
  size_ += width;
  block.mass_vectors = problem_.multiply_mass(block.vectors);
  const MatrixXd removed = remove_basis(block.vectors, block.mass_vectors);
  own += removed.bottomRows(width);
  projected_.block(before, before, width, width) = (own + own.transpose()) / 2;
  largest_ = std::max(largest_, own.cwiseAbs().maxCoeff());
  coupled_ = last_ = before;
  block.coupling = MatrixXd::Identity(width, width);
  set_front(std::move(block), removed, negligible_image * largest_);
  projected_.block(size_, before, front_, width) = coupling_of_front_;
}

RitzPairs KrylovBasis::ritz() const {
  const Index active = size_ - locked_, last = size_ - last_;
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(projected_.block(locked_, locked_, active, active));
  std::vector<Index> order(static_cast<std::size_t>(active));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(pairs.values(a)) > std::abs(pairs.values(b)); });
  RitzPairs result{pairs.values(order), VectorXd::Zero(active), pairs.vectors(Eigen::all, order)};
  if (front_ > 0 && last > 0)
    result.residuals =
        (projected_.block(size_, last_, front_, last) * result.weights.bottomRows(last)).colwise().norm();
  return result;
}

void KrylovBasis::restart(const RitzPairs& ritz, Index kept) {
  const Index active = size_ - locked_, last = size_ - last_;
  const MatrixXd weights = ritz.weights.leftCols(kept);
  const MatrixXd arrow = projected_.block(size_, last_, front_, last) * weights.bottomRows(last);
  const VectorXd of_locked = locked_values();
  combine_columns(vectors_.middleCols(locked_, active), weights, threads_);
  const MatrixXd front = vectors_.middleCols(size_, front_);
  size_ = locked_ + kept;
  vectors_.middleCols(size_, front_) = front;
  projected_.setZero();
  projected_.diagonal().head(locked_) = of_locked;
  projected_.diagonal().segment(locked_, kept) = ritz.values.head(kept);
  projected_.block(size_, locked_, front_, kept) = arrow;
  coupled_ = last_ = locked_;
}

void KrylovBasis::lock(const MatrixXd& W, const VectorXd& values) {
  combine_columns(vectors_.leftCols(size_), W, threads_);
  size_ = locked_ = coupled_ = last_ = W.cols();
  front_ = 0;
  projected_.setZero();
  projected_.diagonal().head(locked_) = values;
}

MatrixXd KrylovBasis::take_locked_vectors() {
  vectors_.conservativeResize(Eigen::NoChange, locked_);
  return std::move(vectors_);
}

}  // namespace bielle
