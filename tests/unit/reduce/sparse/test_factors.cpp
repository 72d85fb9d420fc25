#include <catch2/catch.hpp>

#include "reduce/sparse/dense_factor.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "tests/unit/reduce/sparse/factor_checks.hpp"

using namespace bielle;

TEST_CASE("Every factor passes the checks of `Factor`", "[factor]") {
  const test::FactorKind cholmod{"CHOLMOD", [](const SymmetricMatrix& a, int threads) {
                                   return std::make_unique<SymmetricFactor>(a, std::vector<std::int64_t>(), threads);
                                 }};
  const test::FactorKind dense{"dense", [](const SymmetricMatrix& a, int) { return std::make_unique<DenseFactor>(a); }};
  test::check_all(GENERATE_COPY(cholmod, dense));
}

TEST_CASE("A dense factor refuses NaN, and names the unknown at which a matrix is singular", "[factor]") {
  SymmetricMatrix a = test::grid_laplacian({5, 4, 3});
  a.values[static_cast<std::size_t>(a.starts[30]) + 1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(DenseFactor(a), NotPositiveDefinite);
  try {
    DenseFactor(test::floating_row(40, 5));
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 40);  // the last unknown of the row, where no stiffness remains
  }
}

TEST_CASE("A dense factor counts negative pivots even if a pivot is zero without interchanges", "[factor]") {
  // One matrix has a zero diagonal and the eigenvalues -1 and 1; the shift makes the diagonal of a chain zero.
  const DenseFactor pair(sparse_lower(Eigen::MatrixXd::Identity(2, 2)));
  Eigen::MatrixXd swapped = Eigen::MatrixXd::Zero(2, 2);
  swapped(0, 1) = swapped(1, 0) = 1;
  CHECK(pair.count_signs(sparse_lower(swapped), {1.0, 1.0})->negative == 1);
  const SymmetricMatrix chain = test::grid_laplacian({300, 1, 1});
  const PivotSigns signs = *DenseFactor(chain).count_signs(test::shifted(chain, 2), std::vector<double>(300, 2.0));
  CHECK(signs.negative == 150);
  CHECK(signs.growth == 1);
}
