#include "reduce/spectral/arpack_eigenpairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <arpack/arpack.hpp>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/spectral/start_vectors.hpp"

namespace bielle {

namespace {

/// ARPACK's symmetric shift-invert iteration with its working memory.
class LanczosIteration {
 public:
  LanczosIteration(Eigen::Index size, int wanted, int basis, const EigenpairOptions& options, int seed)
      : size_(static_cast<a_int>(size)),
        wanted_(wanted),
        basis_(basis),
        tolerance_(options.tolerance),
        residual_(StartVectors(size).draw(seed).rightCols(1)),
        lanczos_(size, basis),
        work_(size, 3),
        small_work_(static_cast<std::size_t>(basis * (basis + 8))) {
    parameters_[0] = 1;                 // exact shifts
    parameters_[2] = options.restarts;  // on return: how many were made
    parameters_[3] = 1;                 // block size, the only one implemented
    parameters_[6] = 3;                 // shift-invert
  }

  enum class End { converged, not_converged, no_more_directions };

  /// @param solve  (K - shift M)^-1 b
  template <class Solve>
  End run(const ShiftInvertProblem& problem, const Solve& solve) {
    a_int request = 0;
    while (request != 99) {
      arpack::saupd(request, arpack::bmat::generalized, size_, arpack::which::largest_magnitude, wanted_, tolerance_,
                    residual_.data(), basis_, lanczos_.data(), size_, parameters_.data(), pointers_.data(),
                    work_.data(), small_work_.data(), small_size(), info_);
      if (request == -1) {  // y = OP x
        column(1) = solve(problem.multiply_mass(column(0)));
      } else if (request == 1) {  // the same with M x at hand
        column(1) = solve(column(2));
      } else if (request == 2) {  // y = M x
        column(1) = problem.multiply_mass(column(0));
      } else if (request != 99) {
        throw ComputationError(fmt::format("ARPACK made an unknown request ({})", request));
      }
    }
    constexpr int no_convergence = 1, no_shift_left = 3, no_factorisation = -9999;
    if (info_ == no_factorisation) return End::no_more_directions;
    if (info_ < 0)
      throw ComputationError(fmt::format("the eigenvalue iteration failed (ARPACK's dsaupd returned {})", info_));
    return info_ != no_convergence && info_ != no_shift_left && converged() >= wanted_ ? End::converged
                                                                                       : End::not_converged;
  }
  int directions() const { return parameters_[4]; }  ///< dimension of the space, if there are no more directions
  int converged() const { return parameters_[4]; }
  int restarts() const { return parameters_[2]; }

  /// Returns the pairs that the iteration has found.
  void get(double shift, Eigenpairs& pairs) {
    std::vector<a_int> select(static_cast<std::size_t>(basis_));
    pairs.restarts = restarts();
    pairs.values.resize(wanted_);
    pairs.vectors.resize(size_, wanted_);
    arpack::seupd(1, arpack::howmny::ritz_vectors, select.data(), pairs.values.data(), pairs.vectors.data(), size_,
                  shift, arpack::bmat::generalized, size_, arpack::which::largest_magnitude, wanted_, tolerance_,
                  residual_.data(), basis_, lanczos_.data(), size_, parameters_.data(), pointers_.data(), work_.data(),
                  small_work_.data(), small_size(), info_);
    if (info_ != 0) {
      throw ComputationError(fmt::format("the eigenvectors could not be formed (ARPACK's dseupd returned {})", info_));
    }
  }

 private:
  Eigen::Map<Eigen::VectorXd> column(int pointer) {
    return Eigen::Map<Eigen::VectorXd>(work_.data() + pointers_[static_cast<std::size_t>(pointer)] - 1, size_);
  }
  a_int small_size() const { return static_cast<a_int>(small_work_.size()); }
  a_int size_, wanted_, basis_;
  a_int info_ = 1;  ///< start from `residual_`
  double tolerance_;
  Eigen::VectorXd residual_;
  Eigen::MatrixXd lanczos_, work_;
  std::vector<double> small_work_;
  std::array<a_int, 11> parameters_{}, pointers_{};
};

/// @param known  pairs that are excluded from the search (size, k), M-orthonormal; may be empty
/// @param seed   seed of the start vector
Eigenpairs single_search(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options,
                         const Eigen::MatrixXd& known, int seed) {
  // The number of vectors is such that most problems converge in one sweep: solutions are expensive, vectors are not.
  const auto sensible =
      static_cast<int>(std::min<Eigen::Index>(problem.size, 2 * count + (known.cols() > 0 ? 12 : 20)));
  const auto larger = static_cast<int>(std::min<Eigen::Index>(problem.size, 2 * sensible));
  const Eigen::MatrixXd mass_known = known.cols() > 0 ? problem.multiply_mass(known) : known;
  Eigenpairs pairs;
  const auto solve = [&](const Eigen::MatrixXd& b) {
    ++pairs.solves;
    if (options.on_solve) {
      options.on_solve(pairs.solves);
    }
    Eigen::MatrixXd y = problem.solve(b);
    if (known.cols() > 0) y -= known * (mass_known.transpose() * y);
    return y;
  };
  for (int basis = sensible, found = 0;; basis = found > 0 ? found : larger) {
    LanczosIteration iteration(problem.size, count, basis, options, seed);
    const LanczosIteration::End end = iteration.run(problem, solve);
    if (end == LanczosIteration::End::converged) {
      iteration.get(problem.shift, pairs);
      return pairs;
    }
    if (end == LanczosIteration::End::not_converged && (basis == larger || found > 0))
      throw ComputationError(fmt::format("the eigenvalue iteration stopped after {}, with {} of {} converged",
                                         counted(iteration.restarts(), "restart"), iteration.converged(),
                                         counted(count, "mode")));
    if (end == LanczosIteration::End::no_more_directions) {
      if (found > 0 || iteration.directions() <= count)
        throw TooFewDirections(
            fmt::format("ARPACK finds {} only, of {} wanted; 'method: block_lanczos' takes what there is",
                        counted(iteration.directions(), "direction"), counted(count, "mode")));
      found = iteration.directions();
    }
  }
}

/// Adds copies that were missed. Up to rounding, a Krylov space of one start vector contains one vector of each
/// eigenspace: a copy of a multiple eigenvalue (symmetric bodies) may be missed while others beyond it converge. A
/// second search that excludes the found pairs reveals missed ones; a pair that is better than the worst found one
/// replaces it.
void add_missed_copies(const ShiftInvertProblem& problem, const EigenpairOptions& options, Eigenpairs& pairs) {
  const Eigen::Index count = pairs.values.size();
  constexpr int batch = 3, rounds = 10;
  const auto distance = [&](double value) { return std::abs(value - problem.shift); };
  for (int round = 0; round < rounds; ++round) {
    if (problem.size - count < 100) return;  // dense algebra has found all of a small problem
    EigenpairOptions search = options;
    search.on_solve = [&](int solves) {
      if (options.on_solve) options.on_solve(pairs.solves + solves);
    };
    // Little accuracy is needed to see that nothing is missing. Possibly missed pairs are then computed accurately.
    search.tolerance = std::max(1e-3, options.tolerance);
    const Eigenpairs next = single_search(problem, 1, search, pairs.vectors, 2 * round + 2);
    pairs.solves += next.solves;
    double worst = 0;
    for (const double value : pairs.values) worst = std::max(worst, distance(value));
    if (distance(next.values(0)) > worst * (1 + 2 * search.tolerance)) return;
    search.tolerance = options.tolerance;
    const Eigenpairs others = single_search(problem, batch, search, pairs.vectors, 2 * round + 3);
    pairs.solves += others.solves;
    Eigen::VectorXd values(count + batch);
    Eigen::MatrixXd vectors(problem.size, count + batch);
    values << pairs.values, others.values;
    vectors << pairs.vectors, others.vectors;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(count + batch));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return distance(values(a)) < distance(values(b)); });
    order.resize(static_cast<std::size_t>(count));
    if (std::none_of(order.begin(), order.end(), [&](Eigen::Index k) { return k >= count; })) return;
    pairs.values = values(order).eval();
    pairs.vectors = vectors(Eigen::all, order).eval();
  }
}

}  // namespace

Eigenpairs arpack_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  // ARPACK's products of vectors are short: a second BLAS thread would mostly spin and occupy a core that the products
  // with the mass need.
  const BlasThreads one(1);
  Eigenpairs pairs = single_search(problem, count, options, {}, 1);
  add_missed_copies(problem, options, pairs);
  pairs.sweeps = pairs.solves;
  pairs.method = "ARPACK";
  return pairs;
}

}  // namespace bielle
