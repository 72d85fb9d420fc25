// The space V grows by what the preconditioner P, near K^-1, makes of the residuals of some Ritz vectors,
//     T = P (K x - theta M x),   theta, x from V^T K V y = theta y,   V^T M V = I.
// With P = K^-1 this is the space of a block Lanczos method, since P K x = x is there already; and where P is not, T is
// still right up to the error of P, so that it converges all the same: what P leaves of an error in each step, and what
// the method leaves, whichever is more. References: E. R. Davidson, J. Comput. Phys. 17 (1975) 87; R. B. Morgan,
// D. S. Scott, SIAM J. Sci. Stat. Comput. 7 (1986) 817; G. H. Golub, Q. Ye, SIAM J. Sci. Comput. 24 (2002) 312.
#include "reduce/spectral/davidson.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/symmetric_eigenpairs.hpp"
#include "reduce/spectral/block_lanczos.hpp"
#include "reduce/spectral/start_vectors.hpp"
#include "reduce/spectral/tall_products.hpp"

namespace bielle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Eigenvalues so close to each other, relatively, may be copies of one.
constexpr double same = 1e-5;
/// Directions of a block that are shorter than this, relative to its columns, are rounding.
constexpr double dependent = 1e-10;
/// What a block may contain of the space before it is made orthogonal once more.
constexpr double orthogonal = 1e-2;

class BlockDavidson {
 public:
  BlockDavidson(const ShiftInvertProblem& problem, Index count, const EigenpairOptions& options)
      : problem_(problem),
        options_(options),
        count_(std::min(count, problem.size)),
        block_(std::clamp<Index>(options.block > 0 ? options.block : 8, 1, problem.size)),
        capacity_(std::min(std::max(options.basis > 0 ? options.basis : 3 * count_ + 12 * block_, count_ + 4 * block_),
                           problem.size)),
        vectors_(problem.size, capacity_),
        projected_(MatrixXd::Zero(capacity_, capacity_)) {}

  Eigenpairs run() {
    add(precondition(problem_.multiply_mass(StartVectors(problem_.size).draw(block_))));
    while (true) {
      const SymmetricEigenpairs ritz = symmetric_eigenpairs(projected_.topLeftCorner(size_, size_));
      const std::vector<Index> targets = moving(ritz);
      if (targets.empty() && check(ritz)) return std::move(result_);
      if (!targets.empty()) improve(ritz, targets);
    }
  }

 private:
  MatrixXd precondition(const MatrixXd& b) {
    MatrixXd x = problem_.precondition(b);
    ++result_.sweeps;
    result_.solves += static_cast<int>(b.cols());
    if (options_.on_solve) options_.on_solve(result_.solves);
    return x;
  }

  /// The first Ritz vectors that the last block has changed, or not enough of them yet: as many as a block has. What a
  /// block changes is more than what the next ones will.
  std::vector<Index> moving(const SymmetricEigenpairs& ritz) const {
    const double least = 10 * options_.tolerance;
    std::vector<Index> targets;
    for (Index k = 0; k < std::min(count_, size_) && static_cast<Index>(targets.size()) < block_; ++k)
      if (size_ < count_ || ritz.vectors.col(k).tail(size_ - last_).norm() > least) targets.push_back(k);
    return targets;
  }

  struct Residuals {
    MatrixXd vectors, corrections;  // x, T
  };
  Residuals residuals(const SymmetricEigenpairs& ritz, const std::vector<Index>& of) {
    const MatrixXd weights = ritz.vectors(Eigen::all, of);
    Residuals result{MatrixXd::Zero(problem_.size, weights.cols()), {}};
    add_tall_product(result.vectors, vectors_.leftCols(size_), weights, 1, options_.threads);
    MatrixXd left = problem_.multiply_stiffness(result.vectors);
    const MatrixXd inertia = problem_.multiply_mass(result.vectors);
#pragma omp parallel for num_threads(options_.threads)
    for (Index k = 0; k < left.cols(); ++k)
      left.col(k) -= ritz.values(of[static_cast<std::size_t>(k)]) * inertia.col(k);
    result.corrections = precondition(left);
    return result;
  }

  void improve(const SymmetricEigenpairs& ritz, const std::vector<Index>& targets) {
    MatrixXd corrections = residuals(ritz, targets).corrections;
    if (size_ + corrections.cols() > capacity_) restart(ritz, corrections.cols());
    add(std::move(corrections));
  }

  void restart(const SymmetricEigenpairs& ritz, Index room) {
    if (++result_.restarts > options_.restarts || capacity_ - room < count_)
      throw ComputationError(fmt::format("the eigenvalue iteration stopped after {} without finding {}",
                                         counted(result_.restarts - 1, "restart"), counted(count_, "mode")));
    const Index kept = std::min((size_ + count_) / 2, capacity_ - room);
    combine_columns(vectors_.leftCols(size_), ritz.vectors.leftCols(kept), options_.threads);
    size_ = last_ = kept;
    projected_.setZero();
    projected_.diagonal().head(kept) = ritz.values.head(kept);
  }

  /// The space and a block, or what of it is new.
  void add(MatrixXd block) {
    last_ = size_;
    block = orthonormal(std::move(block));
    if (block.cols() == 0)
      throw ComputationError(fmt::format("the eigenvalue iteration found no more than {} of {}",
                                         counted(size_, "direction"), counted(count_, "mode")));
    const MatrixXd forces = problem_.multiply_stiffness(block);
    const Index width = block.cols();
#pragma omp parallel for num_threads(options_.threads)
    for (Index k = 0; k < width; ++k) vectors_.col(size_ + k) = block.col(k);
    size_ += width;
    const MatrixXd rows = tall_inner_products(vectors_.leftCols(size_), forces, options_.threads);
    projected_.block(last_, 0, width, last_) = rows.topRows(last_).transpose();
    projected_.block(last_, last_, width, width) = (rows.bottomRows(width) + rows.bottomRows(width).transpose()) / 2;
  }

  /// An orthonormal basis (in M) of what a block adds to the space.
  MatrixXd orthonormal(MatrixXd block) const {
    constexpr int most_passes = 6;
    MatrixXd inertia = problem_.multiply_mass(block);
    for (int pass = 0; pass < most_passes && block.cols() > 0; ++pass) {
      const VectorXd before = block.cwiseProduct(inertia).colwise().sum().transpose().cwiseMax(0).cwiseSqrt();
      double removed = 0;
      if (size_ > 0) {
        const MatrixXd shares = tall_inner_products(vectors_.leftCols(size_), inertia, options_.threads);
        add_tall_product(block, vectors_.leftCols(size_), shares, -1, options_.threads);
        inertia = problem_.multiply_mass(block);
        removed = (shares * before.cwiseMax(1e-300).cwiseInverse().asDiagonal()).cwiseAbs().maxCoeff();
      }
      const MatrixXd gram = tall_inner_products(block, inertia, options_.threads);
      const VectorXd lengths = gram.diagonal().cwiseMax(0).cwiseSqrt();
      const VectorXd scale =
          (lengths.array() > 1e-13 * before.array()).select(lengths.cwiseMax(1e-300).cwiseInverse(), 0.0);
      const SymmetricEigenpairs pairs =
          symmetric_eigenpairs(scale.asDiagonal() * ((gram + gram.transpose()) / 2) * scale.asDiagonal());
      const Index width = pairs.values.size();
      const Index dropped = (pairs.values.array() <= dependent * pairs.values(width - 1)).count();
      const Index kept = std::min(width - dropped, problem_.size - size_);
      const bool is_good = kept == width && pairs.values(0) > 0.01 * pairs.values(width - 1) && removed < orthogonal;
      const MatrixXd transform = scale.asDiagonal() * pairs.vectors.rightCols(kept) *
                                 pairs.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
      for (MatrixXd* columns : {&block, &inertia}) {
        combine_columns(*columns, transform, options_.threads);
        columns->conservativeResize(Eigen::NoChange, kept);
      }
      if (is_good) break;
    }
    return block;
  }

  /// Corrects all Ritz pairs that are wanted. False when one of them was not good: the space has its correction.
  bool check(const SymmetricEigenpairs& ritz) {
    constexpr Index few = 16;
    result_.values = ritz.values.head(count_);
    result_.vectors.resize(problem_.size, count_);
    result_.residuals.resize(count_);
    for (Index first = 0; first < count_; first += few) {
      std::vector<Index> some;
      for (Index k = first; k < std::min(count_, first + few); ++k) some.push_back(k);
      Residuals found = residuals(ritz, some);
      const VectorXd lengths =
          found.corrections.cwiseProduct(problem_.multiply_mass(found.corrections)).colwise().sum().transpose();
      const auto width = static_cast<Index>(some.size());
      result_.residuals.segment(first, width) = lengths.cwiseMax(0).cwiseSqrt();
      if (!(result_.residuals.segment(first, width).maxCoeff() <= options_.tolerance)) {
        if (size_ + width > capacity_) restart(ritz, width);
        add(std::move(found.corrections));
        return false;
      }
      result_.vectors.middleCols(first, width) = found.vectors - found.corrections;
    }
    return true;
  }

  const ShiftInvertProblem& problem_;
  const EigenpairOptions& options_;
  Eigenpairs result_;
  Index count_, block_, capacity_;
  MatrixXd vectors_;    // V
  MatrixXd projected_;  // V^T K V, lower triangle
  Index size_ = 0;      // of V
  Index last_ = 0;      // its last block begins here
};

/// As many eigenvalues next to each other as a space that starts from a block has copies?
bool may_miss_copies(const VectorXd& values, Index block) {
  for (Index k = block - 1; k < values.size(); ++k)
    if (values(k) - values(k - block + 1) < same * std::abs(values(k))) return true;
  return false;
}

}  // namespace

Eigenpairs davidson_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  constexpr Index best = 8;
  const Index block = options.block > 0 ? options.block : best;
  Eigenpairs pairs = BlockDavidson(problem, count, options).run();
  if (!may_miss_copies(pairs.values, block)) return pairs;
  pairs = {};
  return block_lanczos_eigenpairs(problem, count, options);
}

}  // namespace bielle
