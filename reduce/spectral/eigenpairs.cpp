#include "reduce/spectral/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <arpack/arpack.hpp>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/symmetric_eigenpairs.hpp"
#include "reduce/spectral/blas.hpp"

namespace bielle {

namespace {

/// The same start vector in every run and on every machine: a linear congruential generator (Knuth's MMIX constants).
Eigen::MatrixXd start_vectors(Eigen::Index size, Eigen::Index count) {
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  Eigen::MatrixXd result(size, count);
  for (double& value : result.reshaped()) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    value = static_cast<double>(static_cast<std::int64_t>(state)) * 0x1p-63;
  }
  return result;
}

/// Ascending eigenvalues, M-normalised vectors with their largest component positive.
void put_in_order(Eigenpairs& pairs) {
  std::vector<Eigen::Index> order(pairs.values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return pairs.values(a) < pairs.values(b); });
  pairs.values = Eigen::VectorXd(pairs.values(order));
  pairs.vectors = Eigen::MatrixXd(pairs.vectors(Eigen::all, order));
  for (auto column : pairs.vectors.colwise()) {
    Eigen::Index largest = 0;
    column.cwiseAbs().maxCoeff(&largest);
    if (column(largest) < 0) {
      column = -column;
    }
  }
}

/// Normalises the vectors and measures what the operator makes of them.
void add_residuals(const ShiftInvertProblem& problem, Eigenpairs& pairs) {
  Eigen::MatrixXd mass_vectors = problem.multiply_mass(pairs.vectors);
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    const double norm = std::sqrt(pairs.vectors.col(k).dot(mass_vectors.col(k)));
    pairs.vectors.col(k) /= norm;
    mass_vectors.col(k) /= norm;
  }
  const Eigen::VectorXd distance = pairs.values.array() - problem.shift;
  const Eigen::MatrixXd error = pairs.vectors - problem.solve(mass_vectors) * distance.asDiagonal();
  pairs.residuals = error.cwiseProduct(problem.multiply_mass(error)).colwise().sum().cwiseMax(0).cwiseSqrt();
}

/// Small problems, densely: S = (K - shift M)^-1 is symmetric, and S M phi = nu phi with nu = 1 / (lambda - shift)
/// becomes M^1/2 S M^1/2 y = nu y, phi = S M^1/2 y / nu. Directions in which S vanishes (constraints) have no
/// eigenvalue.
Eigenpairs dense_eigenpairs(const ShiftInvertProblem& problem, int count) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(problem.size, problem.size);
  const Eigen::MatrixXd mass = problem.multiply_mass(identity);
  const SymmetricEigenpairs of_mass = symmetric_eigenpairs((mass + mass.transpose()) / 2);
  const Eigen::MatrixXd root =
      of_mass.vectors * of_mass.values.cwiseMax(0).cwiseSqrt().asDiagonal() * of_mass.vectors.transpose();
  const Eigen::MatrixXd range = problem.solve(root);
  const Eigen::MatrixXd projected = root * range;
  const SymmetricEigenpairs eigen = symmetric_eigenpairs((projected + projected.transpose()) / 2);
  const Eigen::ArrayXd nu = eigen.values.array();
  const double negligible = 1e-13 * nu.abs().maxCoeff();
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < nu.size(); ++k) {
    if (std::abs(nu(k)) > negligible) {
      order.push_back(k);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(nu(a)) > std::abs(nu(b)); });
  order.resize(std::min<std::size_t>(order.size(), count));
  Eigenpairs pairs;
  pairs.values = problem.shift + nu(order).inverse();
  pairs.vectors = range * eigen.vectors(Eigen::all, order) * nu(order).inverse().matrix().asDiagonal();
  pairs.solves = static_cast<int>(problem.size);
  return pairs;
}

/// ARPACK's symmetric shift-invert iteration with its working memory.
class LanczosIteration {
 public:
  LanczosIteration(Eigen::Index size, int wanted, int basis, const EigenpairOptions& options, int seed)
      : size_(static_cast<a_int>(size)),
        wanted_(wanted),
        basis_(basis),
        tolerance_(options.tolerance),
        residual_(start_vectors(size, seed).rightCols(1)),
        lanczos_(size, basis),
        work_(size, 3),
        small_work_(static_cast<std::size_t>(basis * (basis + 8))) {
    parameters_[0] = 1;                 // exact shifts
    parameters_[2] = options.restarts;  // on return: how many were made
    parameters_[3] = 1;                 // block size, the only one implemented
    parameters_[6] = 3;                 // shift-invert
  }

  /// @param solve  (K - shift M)^-1 b
  template <class Solve>
  void run(const ShiftInvertProblem& problem, const Solve& solve) {
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
    const int converged = parameters_[4];
    if (info_ == 1 || (info_ >= 0 && converged < wanted_)) {
      throw ComputationError(fmt::format("the eigenvalue iteration stopped after {}, with {} of {} converged",
                                         counted(restarts(), "restart"), converged, counted(wanted_, "mode")));
    }
    if (info_ < 0) {
      throw ComputationError(fmt::format("the eigenvalue iteration failed (ARPACK's dsaupd returned {})", info_));
    }
  }

  /// The pairs that were found, once it has run.
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
  int restarts() const { return parameters_[2]; }
  a_int small_size() const { return static_cast<a_int>(small_work_.size()); }
  a_int size_, wanted_, basis_;
  a_int info_ = 1;  ///< start from `residual_`
  double tolerance_;
  Eigen::VectorXd residual_;
  Eigen::MatrixXd lanczos_, work_;
  std::vector<double> small_work_;
  std::array<a_int, 11> parameters_{}, pointers_{};
};

/// @param known  pairs to be kept out of the search (size, k), M-orthonormal; may be empty
/// @param seed   of the start vector
Eigenpairs arpack_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options,
                             const Eigen::MatrixXd& known, int seed) {
  // Enough vectors that most problems converge in one sweep: solutions are expensive, vectors are not.
  const auto basis = static_cast<int>(std::min<Eigen::Index>(problem.size, 2 * count + (known.cols() > 0 ? 12 : 20)));
  const Eigen::MatrixXd mass_known = known.cols() > 0 ? problem.multiply_mass(known) : known;
  Eigenpairs pairs;
  LanczosIteration iteration(problem.size, count, basis, options, seed);
  iteration.run(problem, [&](const Eigen::MatrixXd& b) {
    ++pairs.solves;
    if (options.on_solve) {
      options.on_solve(pairs.solves);
    }
    Eigen::MatrixXd y = problem.solve(b);
    if (known.cols() > 0) y -= known * (mass_known.transpose() * y);
    return y;
  });
  iteration.get(problem.shift, pairs);
  return pairs;
}

/// A Krylov space grown from one vector holds one vector of each eigenspace but for rounding: of a multiple eigenvalue
/// (symmetric bodies) a copy may be missed while others beyond it converge. A search with the found pairs kept out
/// shows what was missed; what is better than the worst found takes its place.
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
    // To see that nothing is missing takes little accuracy. What may be missing is then computed in full.
    search.tolerance = std::max(1e-3, options.tolerance);
    const Eigenpairs next = arpack_eigenpairs(problem, 1, search, pairs.vectors, 2 * round + 2);
    pairs.solves += next.solves;
    double worst = 0;
    for (const double value : pairs.values) worst = std::max(worst, distance(value));
    if (distance(next.values(0)) > worst * (1 + 2 * search.tolerance)) return;
    search.tolerance = options.tolerance;
    const Eigenpairs others = arpack_eigenpairs(problem, batch, search, pairs.vectors, 2 * round + 3);
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

Eigenpairs shift_invert_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  // Below the first size ARPACK's vectors would fill the space anyway; above the second dense matrices cost too much.
  constexpr Eigen::Index small = 60, large = 3000;
  const Eigen::Index n = problem.size;
  if (n > large && count >= n) {
    throw ComputationError(
        fmt::format("all {} eigenpairs of a problem of that size cannot be computed; ask for fewer", n));
  }
  // ARPACK's products of vectors are short: a second BLAS thread would mostly wait, by spinning, and take its core from
  // the products with the mass.
  const BlasThreads one(1);
  const bool dense = n <= small || (n <= large && 2 * static_cast<Eigen::Index>(count) + 20 > n);
  Eigenpairs pairs = dense ? dense_eigenpairs(problem, count) : arpack_eigenpairs(problem, count, options, {}, 1);
  if (!dense) add_missed_copies(problem, options, pairs);
  put_in_order(pairs);
  add_residuals(problem, pairs);
  return pairs;
}

Eigenpairs shift_invert_eigenpairs_below(const ShiftInvertProblem& problem, double limit, int first_guess,
                                         const EigenpairOptions& options, int most) {
  const auto all = static_cast<int>(problem.size);
  int count = std::min(std::max(first_guess, 1), all);
  while (true) {
    Eigenpairs pairs = shift_invert_eigenpairs(problem, count, options);
    const Eigen::Index found = pairs.values.size();
    const Eigen::Index below = (pairs.values.array() <= limit).count();
    if (below < found || found < count || count == all) {
      if (below < found) pairs.next = pairs.values(below);
      pairs.values.conservativeResize(below);
      pairs.vectors.conservativeResize(Eigen::NoChange, below);
      pairs.residuals.conservativeResize(below);
      return pairs;
    }
    // Frequencies of a solid are spaced evenly or denser: extrapolate what was found, and a little more.
    const double ratio = std::sqrt(std::max(1.0, (limit - problem.shift) / (pairs.values(found - 1) - problem.shift)));
    const double more = std::min<double>(all, std::max(count + 10.0, std::ceil(1.2 * ratio * count) + 5));
    if (more > most) throw InputError(fmt::format("about {:.0f} modes seem to lie below it", ratio * count));
    count = static_cast<int>(more);
  }
}

}  // namespace bielle
