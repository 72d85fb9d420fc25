#include "reduce/spectral/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/leading_component.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/dense/tall_products.hpp"
#include "reduce/spectral/arpack_eigenpairs.hpp"
#include "reduce/spectral/block_lanczos.hpp"

namespace bielle {

namespace {

/// Sorts by ascending eigenvalue and makes the leading components of the vectors positive.
void put_in_order(Eigenpairs& pairs) {
  std::vector<Eigen::Index> order(pairs.values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return pairs.values(a) < pairs.values(b); });
  pairs.values = Eigen::VectorXd(pairs.values(order));
  pairs.residuals = Eigen::VectorXd(pairs.residuals(order));
  if (!std::is_sorted(order.begin(), order.end())) pairs.vectors = Eigen::MatrixXd(pairs.vectors(Eigen::all, order));
  for (auto column : pairs.vectors.colwise())
    if (leading_component(column) < 0) column = -column;
}

/// Normalises the vectors, measures their residuals under the operator, and replaces them by its results: a step of
/// inverse iteration, which reduces the parts of other eigenvectors and removes those of directions without mass.
/// Eigenvalues are Rayleigh's quotients.
/// @param most  columns at a time: a few blocks cost as much as one and need less memory
/// @returns V^T M V of the new vectors V, upper triangle
Eigen::MatrixXd polish(const ShiftInvertProblem& problem, Eigen::Index most, int threads, Eigenpairs& pairs) {
  const Eigen::Index count = pairs.values.size();
  pairs.residuals.resize(count);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index first = 0; first < count; first += most) {
    const Eigen::Index width = std::min(most, count - first);
    auto vectors = pairs.vectors.middleCols(first, width);
    Eigen::MatrixXd mass_vectors = problem.multiply_mass(vectors);
#pragma omp parallel for num_threads(threads)
    for (Eigen::Index k = 0; k < width; ++k) {
      const double norm = std::sqrt(vectors.col(k).dot(mass_vectors.col(k)));
      vectors.col(k) /= norm;
      mass_vectors.col(k) /= norm;
    }
    Eigen::MatrixXd error = problem.solve(mass_vectors);
#pragma omp parallel for num_threads(threads)
    for (Eigen::Index k = 0; k < width; ++k) {
      const double distance = 1 / error.col(k).dot(mass_vectors.col(k));
      pairs.values(first + k) = problem.shift + distance;
      error.col(k) = vectors.col(k) - distance * error.col(k);
      vectors.col(k) -= error.col(k);
    }
    const Eigen::MatrixXd mass_error = problem.multiply_mass(error);
#pragma omp parallel for num_threads(threads)
    for (Eigen::Index k = 0; k < width; ++k) {
      pairs.residuals(first + k) = std::sqrt(std::max(0.0, error.col(k).dot(mass_error.col(k))));
      mass_vectors.col(k) -= mass_error.col(k);
    }
    gram.block(0, first, first + width, width) =
        tall_inner_products(pairs.vectors.leftCols(first + width), mass_vectors, threads);
  }
  return gram;
}

/// Removes from each vector the parts of others that rounding in the solutions left: V <- V (I - (V^T M V - I) / 2).
/// @param gram  V^T M V, its upper triangle is read
void make_orthonormal(const Eigen::MatrixXd& gram, Eigen::MatrixXd& vectors, int threads) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(gram.rows(), gram.cols());
  const Eigen::MatrixXd whole = gram.selfadjointView<Eigen::Upper>();
  combine_columns(vectors, identity - (whole - identity) / 2, threads);
}

/// Small problems are solved densely: S = (K - shift M)^-1 is symmetric, and S M phi = nu phi with nu = 1 / (lambda -
/// shift) becomes M^1/2 S M^1/2 y = nu y, phi = S M^1/2 y / nu. Directions in which S vanishes (constraints) have no
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
  pairs.sweeps = 1;
  pairs.method = "dense algebra";
  return pairs;
}

Eigenpairs iterated(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  if (options.iteration) return options.iteration(problem, count, options);
  const bool choose = options.method == EigenMethod::automatic;
  if ((choose ? sensible_method(problem.size, count) : options.method) == EigenMethod::arpack) try {
      return arpack_eigenpairs(problem, count, options);
    } catch (const TooFewDirections&) {
      if (!choose) throw;
    }
  return block_lanczos_eigenpairs(problem, count, options);
}

}  // namespace

EigenMethod sensible_method(Eigen::Index size, int count) {
  constexpr Eigen::Index most_unknowns = 100000;
  constexpr int most_pairs = 61;
  return size <= most_unknowns && count <= most_pairs ? EigenMethod::arpack : EigenMethod::block_lanczos;
}

Eigenpairs shift_invert_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  // Below the first size the vectors of an iteration would span the space anyway; above the second dense matrices are
  // too expensive.
  constexpr Eigen::Index small = 60, large = 3000;
  const Eigen::Index n = problem.size;
  if (n > large && count >= n) {
    throw ComputationError(
        fmt::format("all {} eigenpairs of a problem of that size cannot be computed; ask for fewer", n));
  }
  const bool dense = n <= small || (n <= large && 2 * static_cast<Eigen::Index>(count) + 20 > n);
  Eigenpairs pairs = dense ? dense_eigenpairs(problem, count) : iterated(problem, count, options);
  // An iteration on other machines leaves little memory on this one.
  const Eigen::MatrixXd gram = polish(problem, options.iteration ? 8 : 64, options.threads, pairs);
  make_orthonormal(gram, pairs.vectors, options.threads);
  put_in_order(pairs);
  return pairs;
}

Eigenpairs eigenpairs_below(const std::function<Eigenpairs(int count)>& search, const ShiftInvertProblem& problem,
                            double limit, int first_guess, int most) {
  const auto all = static_cast<int>(problem.size);
  int count = std::min(std::max(first_guess, 1), all);
  while (true) {
    Eigenpairs pairs = search(count);
    const Eigen::Index found = pairs.values.size();
    const Eigen::Index below = (pairs.values.array() <= limit).count();
    if (below < found || found < count || count == all) {
      if (below < found) pairs.next = pairs.values(below);
      pairs.values.conservativeResize(below);
      pairs.vectors.conservativeResize(Eigen::NoChange, below);
      pairs.residuals.conservativeResize(below);
      return pairs;
    }
    // Frequencies of a solid are spaced evenly or denser: the found ones are extrapolated, with a small margin.
    const double ratio = std::sqrt(std::max(1.0, (limit - problem.shift) / (pairs.values(found - 1) - problem.shift)));
    const double more = std::min<double>(all, std::max(count + 10.0, std::ceil(1.2 * ratio * count) + 5));
    if (more > most) throw InputError(fmt::format("about {:.0f} modes seem to lie below it", ratio * count));
    count = static_cast<int>(more);
  }
}

}  // namespace bielle
