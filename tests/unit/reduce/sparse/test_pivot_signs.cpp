#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/sparse/symmetric_factor.hpp"
#include "tests/unit/reduce/sparse/laplacian.hpp"
#include "tests/unit/reduce/spectral/dense_pencil.hpp"

using namespace bielle;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Returns matrices with narrow to wide elimination trees.
const std::vector<std::array<int, 3>> grids{{3000, 1, 1}, {90, 70, 1}, {18, 17, 16}, {2, 2, 2}};

std::vector<double> eigenvalues_of(const std::array<int, 3>& n) {
  std::vector<double> values;
  for (int i = 1; i <= n[0]; ++i)
    for (int j = 1; j <= n[1]; ++j)
      for (int k = 1; k <= n[2]; ++k)
        values.push_back(test::grid_eigenvalue(i, n[0]) + test::grid_eigenvalue(j, n[1]) +
                         test::grid_eigenvalue(k, n[2]));
  std::sort(values.begin(), values.end());
  return values;
}

SymmetricMatrix shifted(SymmetricMatrix a, double shift) {
  for (std::int64_t j = 0; j < a.size; ++j) a.values[static_cast<std::size_t>(a.starts[j])] -= shift;
  return a;
}

}  // namespace

TEST_CASE("pivot signs: the number of negative pivots is that of the eigenvalues below a shift", "[spectral]") {
  for (const auto& n : grids) {
    const SymmetricMatrix a = test::grid_laplacian(n);
    const std::vector<double> exact = eigenvalues_of(n);
    const std::vector<double> scale(static_cast<std::size_t>(a.size), a.values[0]);
    const SymmetricFactor factor(a);
    for (const double part : {0.0, 0.001, 0.03, 1.0}) {
      // The shift is in the widest gap nearby.
      const auto from = static_cast<std::size_t>(part * static_cast<double>(exact.size() - 1));
      std::size_t at = from;
      for (std::size_t k = from; k < std::min(from + 40, exact.size() - 1); ++k)
        if (exact[k + 1] - exact[k] > exact[at + 1 < exact.size() ? at + 1 : at] - exact[at]) at = k;
      const double shift = at + 1 < exact.size() ? (exact[at] + exact[at + 1]) / 2 : exact[at] + 1;
      CAPTURE(n, part, shift);
      const PivotSigns signs = *factor.count_signs(shifted(a, shift), scale);
      CHECK(signs.negative == static_cast<std::int64_t>(at + 1));
      CHECK(signs.growth > 0);
    }
    const PivotSigns definite = *factor.count_signs(a, scale);
    CHECK(definite.negative == 0);
    CHECK(definite.growth <= 1 + 1e-14);  // the sum of L_ij^2 D_jj over j is the diagonal entry
  }
}

TEST_CASE("pivot signs: zero pivots cause growth", "[spectral]") {
  const SymmetricMatrix chain = test::grid_laplacian({300, 1, 1});
  const SymmetricFactor factor(chain);
  const std::vector<double> scale(300, 2.0);
  CHECK(factor.count_signs(shifted(chain, 2), scale)->growth > 1e12);  // a zero diagonal
  CHECK(factor.count_signs(shifted(chain, 0.3), scale)->growth < 1e6);
}

TEST_CASE("pivot signs: both modes of a pair are counted, as of two tuning forks on one base", "[spectral]") {
  // Two equal chains with masses 1/2 are connected by a spring of 1e-9; an eigensolver may take a pair for one mode.
  VectorXd springs = VectorXd::Ones(401);
  springs(200) = 1e-9;
  const SymmetricMatrix chain = sparse_lower(test::chain_of_springs(springs));
  const SymmetricFactor factor(chain);
  for (int pair = 1; pair < 12; ++pair) {
    // A chain of 200 masses that is held at one end has the eigenvalues 4 sin^2((2 k - 1) pi / (2 (2 n + 1))).
    const auto alone = [](int k) { return 4 * std::pow(std::sin((2 * k - 1) * std::numbers::pi / (2 * 401)), 2); };
    const double shift = (alone(pair) + alone(pair + 1)) / 2;
    CHECK(factor.count_signs(shifted(chain, shift), std::vector<double>(400, 2.0))->negative == 2 * pair);
  }
}

TEST_CASE("pivot signs: each condition at the border adds a negative pivot and removes eigenvalues", "[spectral]") {
  // A condition holds the chain at its middle, which makes two chains of half the length and doubles each eigenvalue.
  const int n = 801;
  const SymmetricMatrix chain = test::grid_laplacian({n, 1, 1});
  const SymmetricFactor factor(chain);
  for (int k = 1; k < 20; ++k) {
    const double shift = (test::grid_eigenvalue(k, 400) + test::grid_eigenvalue(k + 1, 400)) / 2;
    const SymmetricMatrix a = bordered(shifted(chain, shift), VectorXd::Unit(n, 400), MatrixXd::Zero(1, 1));
    const PivotSigns signs = *factor.count_signs(a, std::vector<double>(static_cast<std::size_t>(n + 1), 2.0));
    CHECK(signs.negative == 2 * k + 1);
  }
}

TEST_CASE("pivot signs: an exact zero as pivot, and a matrix of one unknown", "[spectral]") {
  const std::vector<double> scale(2, 1.0);
  const SymmetricFactor pair(sparse_lower(MatrixXd::Identity(2, 2))), one(sparse_lower(MatrixXd::Identity(1, 1)));
  MatrixXd swapped = MatrixXd::Zero(2, 2);
  swapped(0, 1) = swapped(1, 0) = 1;
  CHECK(std::isinf(pair.count_signs(sparse_lower(swapped), scale)->growth));
  CHECK(one.count_signs(sparse_lower(MatrixXd::Constant(1, 1, -3)), scale)->negative == 1);
  CHECK(one.count_signs(sparse_lower(MatrixXd::Constant(1, 1, -3)), scale)->growth == 3);
}
