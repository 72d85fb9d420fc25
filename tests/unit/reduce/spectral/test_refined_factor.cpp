#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/spectral/block_graph.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/unit/reduce/spectral/laplacian.hpp"

using namespace bielle;
using Eigen::MatrixXd;

namespace {

/// A part of a matrix, with two dense rows and columns appended, in two precisions.
struct Precisions {
  std::vector<std::int64_t> kept;
  BorderedPart part;
  SymmetricFactor full, single;

  Precisions(const SymmetricMatrix& whole, std::vector<std::int64_t> of_whole, MatrixXd border, MatrixXd corner)
      : kept(std::move(of_whole)),
        part{whole, kept, std::move(border), std::move(corner)},
        full(factor(FactorPrecision::full)),
        single(factor(FactorPrecision::single)) {}

 private:
  SymmetricFactor factor(FactorPrecision precision) const {
    const SymmetricMatrix copy = bordered(principal_submatrix(part.whole, kept), part.border, part.corner);
    return {part, std::make_shared<const FactorStructure>(block_graph(copy, {})), 2, precision};
  }
};

std::vector<std::int64_t> all_but_the_first(std::int64_t size) {
  std::vector<std::int64_t> kept(static_cast<std::size_t>(size - 1));
  std::iota(kept.begin(), kept.end(), 1);
  return kept;
}

/// S A S, S from 1 to `largest`: as of a body whose unknowns have different units.
SymmetricMatrix in_other_units(SymmetricMatrix a, double largest) {
  const auto scale = [&](std::int64_t k) { return std::pow(largest, static_cast<double>(k % 7) / 6); };
  for (std::int64_t j = 0; j < a.size; ++j)
    for (std::int64_t p = a.starts[j]; p < a.starts[j + 1]; ++p) a.values[p] *= scale(j) * scale(a.rows[p]);
  return a;
}

}  // namespace

TEST_CASE("refined factor: solutions are those of double precision, in any units, at half the memory", "[spectral]") {
  const double units = GENERATE(1.0, 1e30, 1e-30), contrast = GENERATE(1.0, 1e6);
  CAPTURE(units, contrast);
  SymmetricMatrix a = in_other_units(test::grid_laplacian({23, 17, 11}), contrast);
  for (double& value : a.values) value *= units;
  const std::int64_t kept = a.size - 1;
  const Precisions factors(a, all_but_the_first(a.size), 0.1 * units * MatrixXd::Random(kept, 2),
                           1e3 * units * MatrixXd::Identity(2, 2));
  MatrixXd b = MatrixXd::Random(kept + 2, 37);
  b.col(3).setZero();
  b.col(20) *= 1e-200;
  const MatrixXd expected = factors.full.solve(b), found = factors.single.solve(b);
  for (Eigen::Index c = 0; c < b.cols(); ++c) CHECK((found - expected).col(c).norm() <= 1e-10 * expected.col(c).norm());
  CHECK(found == factors.single.solve(b));
  const SymmetricMatrix copy = bordered(principal_submatrix(a, factors.kept), factors.part.border, factors.part.corner);
  const MatrixXd product = copy.multiply(RowMatrix(b));
  CHECK((factors.part.multiply(b, 2) - product).norm() <= 1e-13 * product.norm());
  // The factor alone is no more than near.
  const MatrixXd near = factors.single.precondition(b);
  CHECK((near - expected).norm() <= 1e-3 * expected.norm());
  CHECK((near - expected).norm() >= 1e-9 * expected.norm());
  CHECK(factors.single.statistics().is_single);
  CHECK(factors.single.statistics().memory_MB() == factors.full.statistics().memory_MB() / 2);
  CHECK(factors.single.statistics().estimated_MB < 0.7 * factors.full.statistics().estimated_MB);
}

TEST_CASE("refined factor: what is too badly conditioned is solved or said, never wrong", "[spectral]") {
  // Fixed-free chains: their condition grows with the square of their length, to 1e12.
  for (const std::int64_t links : {100, 3000, 100000, 600000}) {
    CAPTURE(links);
    SymmetricMatrix chain;
    chain.size = links;
    for (std::int64_t k = 0; k < links; ++k) {
      chain.rows.push_back(k);
      chain.values.push_back(k + 1 < links ? 2 : 1);
      if (k + 1 < links) {
        chain.rows.push_back(k + 1);
        chain.values.push_back(-1);
      }
      chain.starts.push_back(static_cast<std::int64_t>(chain.rows.size()));
    }
    std::vector<std::int64_t> all(static_cast<std::size_t>(links));
    std::iota(all.begin(), all.end(), 0);
    const BorderedPart part{chain, all, {}, {}};
    MatrixXd b = MatrixXd::Zero(links, 1);
    b(links - 1) = 1;  // pulls the chain evenly: x_k = k + 1
    try {
      const SymmetricFactor factor(part, std::make_shared<const FactorStructure>(block_graph(chain, {})), 2,
                                   FactorPrecision::single);
      const MatrixXd x = factor.solve(b);
      const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(links, 1, static_cast<double>(links));
      CHECK((x - exact).cwiseAbs().maxCoeff() <= 1e-9 * static_cast<double>(links));
    } catch (const ComputationError&) {
      CHECK(links > 3000);
    }
  }
}
