#include <catch2/catch.hpp>

#include "reduce/sparse/dense_factor.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "tests/unit/reduce/sparse/factor_checks.hpp"

using namespace bielle;

TEST_CASE("Every factor does what `Factor` promises", "[factor]") {
  const test::FactorKind cholmod{"CHOLMOD", [](const SymmetricMatrix& a, int threads) {
                                   return std::make_unique<SymmetricFactor>(a, std::vector<std::int64_t>(), threads);
                                 }};
  const test::FactorKind dense{"dense", [](const SymmetricMatrix& a, int) { return std::make_unique<DenseFactor>(a); }};
  test::check_all(GENERATE_COPY(cholmod, dense));
}

TEST_CASE("A dense factor refuses numbers that are none, and names the unknown that shows what is wrong", "[factor]") {
  SymmetricMatrix a = test::grid_laplacian({5, 4, 3});
  a.values[static_cast<std::size_t>(a.starts[30]) + 1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(DenseFactor(a), NotPositiveDefinite);
  try {
    DenseFactor(test::floating_row(40, 5));
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 40);  // the last of the row, where nothing is left of its stiffness
  }
}

TEST_CASE("A dense factor counts where a pivot without interchanges vanishes", "[factor]") {
  // Eigenvalues -1 and 1 above a zero diagonal, and a chain whose diagonal the shift takes away.
  const DenseFactor pair(sparse_lower(Eigen::MatrixXd::Identity(2, 2)));
  Eigen::MatrixXd swapped = Eigen::MatrixXd::Zero(2, 2);
  swapped(0, 1) = swapped(1, 0) = 1;
  CHECK(pair.count_signs(sparse_lower(swapped), {1.0, 1.0})->negative == 1);
  const SymmetricMatrix chain = test::grid_laplacian({300, 1, 1});
  const PivotSigns signs = *DenseFactor(chain).count_signs(test::shifted(chain, 2), std::vector<double>(300, 2.0));
  CHECK(signs.negative == 150);
  CHECK(signs.growth == 1);
}
