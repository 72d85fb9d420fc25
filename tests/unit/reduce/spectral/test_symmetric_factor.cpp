#include <numeric>
#include <string>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include "reduce/common/address_space.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/free_memory.hpp"
#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/unit/reduce/spectral/laplacian.hpp"

using namespace bielle;

TEST_CASE("Solutions with a factorised matrix leave residuals at rounding level") {
  const SymmetricMatrix a = test::grid_laplacian({17, 13, 11});
  const SymmetricFactor factor(a, {}, 2);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 5);
  const Eigen::MatrixXd x = factor.solve(b);
  // Backward stable: |A x - b| <= c n eps |A||x| with |A| = 12 and |x| of the order of 10 |b|.
  CHECK((Eigen::MatrixXd(a.multiply(x)) - b).norm() < 1e-12 * b.norm());
  for (Eigen::Index k = 0; k < b.cols(); ++k) {
    CHECK((factor.solve(b.col(k)) - x.col(k)).norm() < 1e-13 * x.col(k).norm());
  }
  CHECK(factor.statistics().unknowns == a.size);
  CHECK(factor.statistics().nonzeros >= static_cast<std::int64_t>(a.values.size()));
  CHECK(factor.statistics().flops > 0);
}

TEST_CASE("An order found on blocks of unknowns gives the same solution") {
  // Three unknowns per grid point, coupled through a full 3x3 matrix.
  const SymmetricMatrix grid = test::grid_laplacian({9, 8, 7});
  const Eigen::Matrix3d coupling = (Eigen::Matrix3d() << 4, 1, 0.5, 1, 3, -1, 0.5, -1, 5).finished();
  SymmetricMatrix a;
  a.size = 3 * grid.size;
  for (std::int64_t b = 0; b < grid.size; ++b) {
    for (int j = 0; j < 3; ++j) {
      for (std::int64_t p = grid.starts[b]; p < grid.starts[b + 1]; ++p) {
        for (int i = grid.rows[p] == b ? j : 0; i < 3; ++i) {
          a.rows.push_back(3 * grid.rows[p] + i);
          a.values.push_back(grid.values[p] * coupling(i, j));
        }
      }
      a.starts.push_back(static_cast<std::int64_t>(a.rows.size()));
    }
  }
  std::vector<std::int64_t> starts(grid.size + 1);
  for (std::int64_t b = 0; b <= grid.size; ++b) {
    starts[b] = 3 * b;
  }
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 2);
  const SymmetricFactor by_blocks(a, starts), by_unknowns(a);
  CHECK((by_blocks.solve(b) - by_unknowns.solve(b)).norm() < 1e-12 * by_unknowns.solve(b).norm());
}

TEST_CASE("A small dense matrix is solved as by Eigen") {
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(7, 7);
  const Eigen::MatrixXd a = root * root.transpose() + Eigen::MatrixXd::Identity(7, 7);
  const SymmetricFactor factor(sparse_lower(a));
  CHECK((factor.solve(Eigen::MatrixXd::Identity(7, 7)) - a.inverse()).norm() < 1e-13 * a.inverse().norm());
}

TEST_CASE("A matrix that is not positive definite is refused with the unknown where it shows") {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(6, 6);
  a(4, 4) = -1;
  try {
    SymmetricFactor factor(sparse_lower(a));
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 4);
  }
}

TEST_CASE("A floating chain of springs is singular to working precision and refused") {
  const int n = 50;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (int i = 0; i + 1 < 2 * n; ++i) {
    if (i + 1 == n) {
      continue;  // two chains: the second holds on to nothing
    }
    chain.block<2, 2>(i, i) += (Eigen::Matrix2d() << 1, -1, -1, 1).finished() * 0.7;
  }
  chain(0, 0) += 1;
  try {
    SymmetricFactor factor(sparse_lower(chain));
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() >= n);
  }
}

#ifndef __SANITIZE_ADDRESS__  // which takes more address space than any limit
TEST_CASE("A factor that will not fit is refused before it is computed, with the estimate") {
  const SymmetricMatrix a = test::grid_laplacian({40, 40, 40});
  const FactorStatistics whole = SymmetricFactor(a).statistics();
  CHECK(whole.estimated_MB >= whole.memory_MB());  // padding, indices and the update matrix come on top
  CHECK(whole.estimated_MB < 2.5 * whole.memory_MB());
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  // What the heap holds free at its end would go back to the system while the factor is analysed, and more would be
  // left then than the limit says now.
  malloc_trim(0);
  // Lowers the limit until less is left than the factor needs, yet enough for its symbolic analysis.
  const double wanted = 0.9 * whole.estimated_MB;
  rlimit lower = before;
  lower.rlim_cur = address_space() + static_cast<rlim_t>(1e6 * wanted);
  REQUIRE(setrlimit(RLIMIT_AS, &lower) == 0);
  std::string said;
  const double left = free_memory_MB();
  try {
    const SymmetricFactor factor(a);
  } catch (const ComputationError& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_AS, &before);
  CHECK(left == Approx(wanted).margin(1));
  CHECK_THAT(said, Catch::Contains(fmt::format("needs about {:.0f} MB", whole.estimated_MB)));
  CHECK_NOTHROW(SymmetricFactor(a));
}
#endif

TEST_CASE("The BLAS says what it is") {
  CHECK_THAT(blas_description(), Catch::Contains("OpenBLAS"));
  CHECK_THAT(blas_description(), Catch::Contains("kernels for"));
}
