#include "reduce/sparse/dense_factor.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "reduce/dense/blas.hpp"
#include "reduce/dense/symmetric_factors.hpp"

namespace bielle {

namespace {

Eigen::MatrixXd dense_lower(const SymmetricMatrix& a) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int64_t j = 0; j < a.size; ++j)
    for (std::int64_t p = a.starts[static_cast<std::size_t>(j)]; p < a.starts[static_cast<std::size_t>(j) + 1]; ++p)
      lower(a.rows[static_cast<std::size_t>(p)], j) = a.values[static_cast<std::size_t>(p)];
  return lower;
}

}  // namespace

DenseFactor::DenseFactor(const SymmetricMatrix& a) : lower_(dense_lower(a)) {
  const auto start = std::chrono::steady_clock::now();
  const auto n = static_cast<double>(a.size);
  const Eigen::VectorXd diagonal = lower_.diagonal();
  for (Eigen::Index j = 0; j < a.size; ++j)
    if (!(diagonal(j) > 0)) throw NotPositiveDefinite(j);
  const BlasThreads one(1);
  if (const auto bad = factorise_definite(lower_)) throw NotPositiveDefinite(*bad);
  const Eigen::ArrayXd pivots = lower_.diagonal().array().square();
  for (Eigen::Index j = 0; j < a.size; ++j)
    if (!(pivots(j) > singular_pivot * diagonal(j))) throw NotPositiveDefinite(j);
  statistics_.unknowns = a.size;
  statistics_.nonzeros = a.size * (a.size + 1) / 2;
  statistics_.flops = n * n * n / 3;
  statistics_.estimated_MB = 8e-6 * n * n;
  statistics_.reciprocal_condition = a.size > 0 ? pivots.minCoeff() / pivots.maxCoeff() : 0;
  statistics_.factorisation_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Eigen::MatrixXd DenseFactor::solve(const Eigen::MatrixXd& b) const {
  const BlasThreads one(1);
  Eigen::MatrixXd x = b;
  solve_definite(lower_, x);
  return x;
}

std::optional<PivotSigns> DenseFactor::count_signs(const SymmetricMatrix& a, const std::vector<double>& scale) const {
  const BlasThreads one(1);
  const Eigen::Map<const Eigen::VectorXd> sizes(scale.data(), static_cast<Eigen::Index>(scale.size()));
  const EigenvalueSigns signs = eigenvalue_signs(dense_lower(a), sizes);
  return PivotSigns{signs.negative, signs.unknown > 0 ? std::numeric_limits<double>::infinity() : 1};
}

}  // namespace bielle
