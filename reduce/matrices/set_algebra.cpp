#include "reduce/matrices/set_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/sparse/dense_factor.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

namespace {

/// Up to this size all eigenpairs are computed densely in about a second.
constexpr Eigen::Index most_dense_eigenvalues = 600;

SymmetricMatrix lower_half(const SparseColumns& A) {
  SymmetricMatrix result;
  result.size = A.cols();
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    const std::size_t diagonal = result.values.size();
    result.rows.push_back(j);
    result.values.push_back(0);
    for (SparseColumns::InnerIterator entry(A, j); entry; ++entry) {
      if (entry.row() == j) result.values[diagonal] = entry.value();
      if (entry.row() <= j || entry.value() == 0) continue;
      result.rows.push_back(entry.row());
      result.values.push_back(entry.value());
    }
    result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
  }
  return result;
}

SparseColumns with_added_diagonal(const SparseColumns& A, double added) {
  SparseColumns identity(A.rows(), A.cols());
  identity.setIdentity();
  return A + added * identity;
}

Eigen::Index largest_part(const Eigen::VectorXd& vector) {
  Eigen::Index at = 0;
  vector.cwiseAbs().maxCoeff(&at);
  return at;
}

/// Returns the least eigenpair of a large matrix with a diagonal of about one, by inverse iteration from below. The
/// distance grows until the shifted matrix is definite, which Gershgorin's theorem bounds.
LeastEigenvalue least_of_large(const SparseColumns& A, int threads) {
  const auto n = A.cols();
  double distance = 1e-7;
  while (true) {
    try {
      const std::unique_ptr<Factor> factor = definite_factor(with_added_diagonal(A, distance), threads);
      const ShiftInvertProblem problem{n, -distance, [&](const Eigen::MatrixXd& b) { return factor->solve(b); },
                                       [](const Eigen::MatrixXd& x) { return x; }};
      EigenpairOptions options;
      options.threads = threads;
      options.tolerance = 1e-4;  // relative to the distance from the shift; only the order of magnitude is needed
      const Eigenpairs pairs = shift_invert_eigenpairs(problem, 1, options);
      return {pairs.values(0), largest_part(pairs.vectors.col(0))};
    } catch (const NotPositiveDefinite&) {
      if (distance > 1e6) throw;
      distance *= 30;
    }
  }
}

NaturalModes dense_modes(const SparseColumns& K, const SparseColumns& M, int count, double shift) {
  const Eigen::MatrixXd stiffness(K), mass(M);
  // M x = mu (K + shift M) x has no infinite eigenvalue although M may be singular.
  const std::optional<SymmetricEigenpairs> pairs = symmetric_eigenpairs(mass, stiffness + shift * mass);
  if (!pairs) throw NotPositiveDefinite(0);
  const Eigen::Index with_mass = (pairs->values.array() > 1e-14 * pairs->values.maxCoeff()).count();
  const Eigen::Index kept = std::min<Eigen::Index>(count, with_mass);
  NaturalModes result;
  result.vectors = pairs->vectors.rightCols(kept).rowwise().reverse();
  result.eigenvalues.resize(kept);
  for (Eigen::Index k = 0; k < kept; ++k) {
    Eigen::VectorXd x = result.vectors.col(k);
    x /= std::sqrt(x.dot(mass * x));
    result.vectors.col(k) = x;
    result.eigenvalues(k) = x.dot(stiffness * x);
  }
  return result;
}

}  // namespace

SparseColumns symmetric_part(const SparseColumns& A) {
  const SparseColumns transposed = A.transpose();
  return 0.5 * (A + transposed);
}

SparseColumns submatrix(const SparseColumns& A, const Unknowns& rows, const Unknowns& columns) {
  std::vector<int> row_of(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) row_of[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (SparseColumns::InnerIterator entry(A, columns[j]); entry; ++entry)
      if (const int i = row_of[static_cast<std::size_t>(entry.row())]; i >= 0)
        entries.emplace_back(i, static_cast<int>(j), entry.value());
  SparseColumns result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::unique_ptr<Factor> definite_factor(const SparseColumns& A, int threads) {
  const SymmetricMatrix lower = lower_half(A);
  if (lower.size <= most_dense_unknowns) return std::make_unique<DenseFactor>(lower);
  return std::make_unique<SymmetricFactor>(lower, std::span<const std::int64_t>{}, threads);
}

std::optional<LeastEigenvalue> least_scaled_eigenvalue(const SparseColumns& A, int threads) {
  Eigen::VectorXd scale = Eigen::VectorXd(A.diagonal()).cwiseAbs();
  Unknowns kept;
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    double largest = 0;
    for (SparseColumns::InnerIterator entry(A, j); entry; ++entry) largest = std::max(largest, std::abs(entry.value()));
    if (largest > 0) kept.push_back(j);
    scale(j) = scale(j) > 0 ? 1 / std::sqrt(scale(j)) : 1;
  }
  if (kept.empty()) return std::nullopt;
  const SparseColumns scaled = submatrix(scale.asDiagonal() * A * scale.asDiagonal(), kept, kept);
  LeastEigenvalue least;
  if (scaled.cols() <= most_dense_eigenvalues) {
    const SymmetricEigenpairs pairs = symmetric_eigenpairs(Eigen::MatrixXd(scaled));
    least = {pairs.values(0), largest_part(pairs.vectors.col(0))};
  } else {
    least = least_of_large(scaled, threads);
  }
  least.unknown = kept[static_cast<std::size_t>(least.unknown)];
  return least;
}

NaturalModes natural_modes(const SparseColumns& K, const SparseColumns& M, int count, double shift, int threads) {
  if (K.cols() <= most_dense_eigenvalues) return dense_modes(K, M, count, shift);
  const std::unique_ptr<Factor> factor = definite_factor(K + shift * M, threads);
  const ShiftInvertProblem problem{K.cols(), -shift, [&](const Eigen::MatrixXd& b) { return factor->solve(b); },
                                   [&](const Eigen::MatrixXd& x) { return Eigen::MatrixXd(M * x); }};
  EigenpairOptions options;
  options.threads = threads;
  Eigenpairs pairs = shift_invert_eigenpairs(problem, count, options);
  return {std::move(pairs.values), std::move(pairs.vectors)};
}

double signed_frequency(double eigenvalue) {
  return std::copysign(std::sqrt(std::abs(eigenvalue)), eigenvalue) / (2 * std::numbers::pi);
}

Eigen::MatrixXd few_least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::VectorXd scale = A.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd unit = A * scale.asDiagonal();
  return scale.asDiagonal() * solve_symmetric(transposed_product(unit, unit), transposed_product(unit, B));
}

}  // namespace bielle::reduce
