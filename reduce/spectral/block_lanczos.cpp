#include "reduce/spectral/block_lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/spectral/krylov_basis.hpp"

namespace bielle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Eigenvalues with a relative difference below this may be copies of one.
constexpr double close = 1e-3;
/// Little accuracy is needed to see that nothing is missing.
constexpr double look = 1e-3;
/// An eigenvalue within this relative distance of the worst found one is no improvement.
constexpr double equal = 1e-9;
/// A |nu| below this share of the largest counts as zero, as for directions in which S M vanishes.
constexpr double vanishing = 1e-13;

Index block_columns(const EigenpairOptions& options, Index size) {
  constexpr Index best = 8;  // as measured (performance_reduce_modes)
  return std::clamp<Index>(options.block > 0 ? options.block : best, 1, size);
}

Index basis_columns(const EigenpairOptions& options, Index size, Index count, Index block) {
  const Index wanted = options.basis > 0 ? options.basis : 3 * count + 12 * block;
  return std::min(std::max(wanted, count + 4 * block), size) + block;
}

class BlockLanczos {
 public:
  BlockLanczos(const ShiftInvertProblem& problem, Index count, const EigenpairOptions& options)
      : options_(options),
        count_(std::min(count, problem.size)),
        block_(block_columns(options, problem.size)),
        basis_(problem, basis_columns(options, problem.size, count_, block_), options.threads,
               [this](Index columns) { note(columns); }) {}

  Eigenpairs run(double shift) {
    find();
    while (may_miss_copies() && find_missed()) {
    }
    result_.values = shift + basis_.locked_values().array().inverse();
    result_.vectors = basis_.take_locked_vectors();
    result_.method = "block Lanczos";
    return std::move(result_);
  }

 private:
  void note(Index columns) {
    ++result_.sweeps;
    result_.solves += static_cast<int>(columns);
    if (options_.on_solve) options_.on_solve(result_.solves);
  }

  bool is_converged(const RitzPairs& ritz, Index k) const {
    return ritz.residuals(k) <= options_.tolerance * std::abs(ritz.values(k));
  }
  Index converged(const RitzPairs& ritz, Index most) const {
    Index k = 0;
    while (k < std::min(most, ritz.size()) && is_converged(ritz, k)) ++k;
    return k;
  }

  /// Adds another block to the space. Returns false if there are no more directions.
  bool grow() {
    if (basis_.front() == 0) {
      basis_.start(std::min(block_, basis_.room()));
      starts_ += basis_.front();
    }
    if (basis_.front() == 0) return false;
    basis_.expand();
    return true;
  }

  /// Returns the size at which convergence is tested again, depending on the number of pairs that have converged since
  /// the last test; dense eigenvalues of large bases are costly.
  Index next_test(Index found) {
    const Index size = basis_.size(), grown = size - tested_size_, more = found - tested_found_;
    const Index most = size / 12;
    tested_size_ = size;
    tested_found_ = found;
    return size + (grown > 0 && more > 0 ? std::min(most, (count_ - found) * grown / more) : most);
  }

  bool is_full() const { return basis_.room() < std::max(basis_.front(), Index{1}); }

  void restart(const RitzPairs& ritz) {
    if (result_.restarts == options_.restarts)
      throw ComputationError(fmt::format("the eigenvalue iteration stopped after {}, with {} of {} converged",
                                         counted(result_.restarts, "restart"), converged(ritz, count_),
                                         counted(count_, "mode")));
    ++result_.restarts;
    const Index least = basis_.front() + block_;  // columns that must remain free
    const Index most = basis_.room() + ritz.size() - least;
    basis_.restart(ritz, std::clamp<Index>((ritz.size() + count_) / 2, 1, most));
  }

  /// Finds and locks the first `count` pairs; fewer if there are no more.
  void find() {
    Index test_at = count_ + count_ / 2;
    while (grow()) {
      if (basis_.size() < test_at && !is_full()) continue;
      const RitzPairs ritz = basis_.ritz();
      const Index found = converged(ritz, count_);
      if (found == count_) return lock(ritz, count_);
      if (is_full()) restart(ritz);
      test_at = next_test(found);
    }
    if (basis_.size() == 0) return;
    const RitzPairs ritz = basis_.ritz();  // pairs of the whole space
    const Index exist = (ritz.values.array().abs() > vanishing * ritz.values.cwiseAbs().maxCoeff()).count();
    lock(ritz, std::min(count_, exist));
  }

  /// Tells whether there are as many adjacent, nearly equal eigenvalues as there were random vectors.
  bool may_miss_copies() const {
    if (basis_.locked() < count_) return false;
    VectorXd values = basis_.locked_values();
    std::sort(values.begin(), values.end());
    Index run = 1, longest = 1;
    for (Index k = 1; k < values.size(); ++k) {
      run = values(k) - values(k - 1) < close * std::abs(values(k)) ? run + 1 : 1;
      longest = std::max(longest, run);
    }
    return longest >= starts_;
  }

  /// Searches for pairs besides the locked ones. A pair that is better than the worst locked one replaces it. Returns
  /// false if there is none.
  bool find_missed() {
    const double worst = basis_.locked_values().cwiseAbs().minCoeff();
    while (true) {
      const bool grown = grow();
      if (!grown && basis_.size() == basis_.locked()) return false;
      const RitzPairs ritz = basis_.ritz();
      const Index good = converged(ritz, ritz.size());
      const Index better = (ritz.values.array().abs() > worst * (1 + equal)).count();
      const double best = std::abs(ritz.values(0));
      if (best + ritz.residuals(0) < worst && ritz.residuals(0) <= look * best) return false;
      if (good > 0 && better == 0) return false;
      if (better > 0 && (good >= better || !grown)) {
        lock(ritz, better);
        return true;
      }
      if (is_full()) restart(ritz);
    }
  }

  /// Locks the best `count` of the locked pairs and the first `found` Ritz vectors.
  void lock(const RitzPairs& ritz, Index found) {
    const Index old = basis_.locked();
    VectorXd values(old + found);
    values << basis_.locked_values(), ritz.values.head(found);
    MatrixXd weights = MatrixXd::Zero(basis_.size(), old + found);
    weights.topLeftCorner(old, old).setIdentity();
    weights.bottomRightCorner(ritz.size(), found) = ritz.weights.leftCols(found);
    std::vector<Index> order(static_cast<std::size_t>(old + found));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return std::abs(values(a)) > std::abs(values(b)); });
    order.resize(std::min(order.size(), static_cast<std::size_t>(count_)));
    basis_.lock(weights(Eigen::all, order), values(order));
  }

  const EigenpairOptions& options_;
  Eigenpairs result_;
  Index count_, block_;
  Index tested_size_ = 0, tested_found_ = 0;  // size of the basis at the last test, and number of pairs that had
                                              // converged
  Index starts_ = 0;                          // random vectors that the search has started from
  KrylovBasis basis_;
};

}  // namespace

Eigenpairs block_lanczos_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  return BlockLanczos(problem, count, options).run(problem.shift);
}

}  // namespace bielle
