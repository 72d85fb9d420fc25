#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/address_space.hpp"
#include "reduce/common/process/free_memory.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/sparse/block_graph.hpp"
#include "reduce/sparse/factor_structure.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "tests/unit/reduce/sparse/laplacian.hpp"

using namespace bielle;

TEST_CASE("Solutions with a factorised matrix have residuals of the size of rounding") {
  const SymmetricMatrix a = test::grid_laplacian({17, 13, 11});
  const SymmetricFactor factor(a, {}, 2);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 5);
  const Eigen::MatrixXd x = factor.solve(b);
  // A backward stable solution has |A x - b| <= c n eps |A||x|, with |A| = 12 and |x| of the order of 10 |b|.
  CHECK((Eigen::MatrixXd(a.multiply(x)) - b).norm() < 1e-12 * b.norm());
  for (Eigen::Index k = 0; k < b.cols(); ++k) {
    CHECK((factor.solve(b.col(k)) - x.col(k)).norm() < 1e-13 * x.col(k).norm());
  }
  CHECK(factor.statistics().unknowns == a.size);
  CHECK(factor.statistics().nonzeros >= static_cast<std::int64_t>(a.values.size()));
  CHECK(factor.statistics().flops > 0);
}

namespace {

/// Returns the largest |A x - b| relative to |A| |x| + |b| with |A| <= 12, which a backward stable solution makes of
/// the order of eps.
double residual(const SymmetricMatrix& a, const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) {
  return (Eigen::MatrixXd(a.multiply(x)) - b).cwiseAbs().maxCoeff() /
         (12 * x.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("A factor solves any shape of matrix, with any number of columns and of threads", "[spectral]") {
  // The matrices range from chains with narrow elimination trees to solids with wide supernodes at the root.
  for (const auto& n : {std::array{3000, 1, 1}, {60, 50, 1}, {17, 16, 15}, {2, 2, 2}, {1, 1, 1}}) {
    SymmetricMatrix a = test::grid_laplacian(n);
    if (a.size == 1) a.values[0] = 3;
    const Eigen::MatrixXd all = Eigen::MatrixXd::Random(a.size, 90), exact = SymmetricFactor(a).solve(all);
    for (const int threads : {1, 2, 5}) {
      const SymmetricFactor factor(a, {}, threads);
      for (const int columns : {0, 1, 7, 16, 90}) {
        CAPTURE(n, threads, columns);
        const Eigen::MatrixXd b = all.leftCols(columns), x = factor.solve(b);
        REQUIRE(x.cols() == columns);
        if (columns == 0) continue;
        CHECK(residual(a, x, b) < 1e-14);
        CHECK(factor.solve(b) == x);
        CHECK((x - exact.leftCols(columns)).norm() < 1e-12 * x.norm());
      }
    }
  }
}

TEST_CASE("A matrix of several independent parts is factorised", "[spectral]") {
  const SymmetricMatrix part = test::grid_laplacian({9, 10, 11});
  SymmetricMatrix a;
  for (int copy = 0; copy < 3; ++copy) {
    const std::int64_t before = a.size, entries = a.starts.back();
    a.size += part.size;
    for (const std::int64_t row : part.rows) a.rows.push_back(row + before);
    a.values.insert(a.values.end(), part.values.begin(), part.values.end());
    for (std::size_t k = 1; k < part.starts.size(); ++k) a.starts.push_back(entries + part.starts[k]);
  }
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 9);
  CHECK(residual(a, SymmetricFactor(a, {}, 2).solve(b), b) < 1e-14);
}

TEST_CASE("Several threads may use one factor at the same time", "[spectral]") {
  const SymmetricMatrix a = test::grid_laplacian({20, 19, 18});
  const SymmetricFactor factor(a, {}, 2);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 8), x = factor.solve(b);
  std::array<Eigen::MatrixXd, 2> inside;
#pragma omp parallel for num_threads(2)
  for (int k = 0; k < 2; ++k) inside[static_cast<std::size_t>(k)] = factor.solve(b);
  CHECK(inside[0] == x);
  CHECK(inside[1] == x);
}

TEST_CASE("A structure can be used for any matrix whose pattern it contains", "[spectral]") {
  const SymmetricMatrix whole = test::grid_laplacian({12, 11, 10});
  std::vector<std::int64_t> kept;
  for (std::int64_t k = 0; k < whole.size; ++k)
    if (k % 7 != 3) kept.push_back(k);
  Eigen::MatrixXd border = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(kept.size()), 2);
  border.block(5, 0, 40, 1).setConstant(0.1);
  border.block(30, 1, 60, 1).setConstant(-0.05);
  const Eigen::MatrixXd corner = (Eigen::Matrix2d() << 9, 1, 1, 8).finished();
  const SymmetricMatrix more = bordered(principal_submatrix(whole, kept), border, corner);
  const SymmetricMatrix less = bordered(principal_submatrix(whole, kept), 0 * border, corner);
  const auto structure = std::make_shared<const FactorStructure>(block_graph(more, {}));
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(more.size, 3);
  for (const SymmetricMatrix& a : {more, less}) {
    const SymmetricFactor factor(structure, a, 2);
    CHECK(residual(a, factor.solve(b), b) < 1e-14);
    CHECK(factor.statistics().nonzeros == structure->nonzeros());
    CHECK(static_cast<double>(structure->values()) >= static_cast<double>(structure->nonzeros()));
  }
  SymmetricMatrix bad = more;
  bad.values[static_cast<std::size_t>(bad.starts[17])] = -1;
  try {
    SymmetricFactor(structure, bad, 2);
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 17);
  }
}

TEST_CASE("An indefinite matrix with a positive diagonal is refused", "[spectral]") {
  const SymmetricMatrix a = test::grid_laplacian({20, 18, 17});
  for (std::int64_t bad = 11; bad < a.size; bad += a.size / 5) {
    SymmetricMatrix indefinite = a;
    indefinite.values[static_cast<std::size_t>(indefinite.starts[static_cast<std::size_t>(bad)])] = 0.5;
    CAPTURE(bad);
    std::vector<std::int64_t> named;
    for (const int threads : {1, 2, 5}) {
      try {
        SymmetricFactor(indefinite, {}, threads);
        FAIL("accepted");
      } catch (const NotPositiveDefinite& error) {
        named.push_back(error.unknown());
      }
    }
    CHECK(named == std::vector<std::int64_t>(3, named[0]));
  }
}

TEST_CASE("NaN is refused", "[spectral]") {
  SymmetricMatrix a = test::grid_laplacian({9, 8, 7});
  a.values[static_cast<std::size_t>(a.starts[100]) + 1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(SymmetricFactor(a, {}, 2), NotPositiveDefinite);
}

TEST_CASE("An elimination order found on blocks of unknowns gives the same solution") {
  // Each grid point has three unknowns, which a full 3x3 matrix couples.
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

TEST_CASE("A matrix that is not positive definite is refused with the unknown of the wrong pivot") {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(6, 6);
  a(4, 4) = -1;
  try {
    SymmetricFactor factor(sparse_lower(a));
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 4);
  }
}

TEST_CASE("A free chain of springs is singular to working precision and refused") {
  const int n = 50;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (int i = 0; i + 1 < 2 * n; ++i) {
    if (i + 1 == n) {
      continue;  // two chains, of which the second one is free
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

#ifndef __SANITIZE_ADDRESS__  // sanitizers use more address space than any limit
TEST_CASE("A factor that does not fit in memory is refused before it is computed, with the estimate") {
  const SymmetricMatrix a = test::grid_laplacian({30, 30, 30});
  const FactorStatistics whole = SymmetricFactor(a).statistics();
  CHECK(whole.estimated_MB >= whole.memory_MB());  // the estimate includes padding, indices and the update matrix
  CHECK(whole.estimated_MB < 2.5 * whole.memory_MB());
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  // Free memory at the end of the heap would be returned to the system during the analysis of the factor; then more
  // memory would be available than the limit allows now.
  malloc_trim(0);
  // Lowers the limit until less remains than the factor needs, but enough for its symbolic analysis.
  const double wanted = 0.9 * whole.estimated_MB;
  rlimit lower = before;
  lower.rlim_cur = address_space() + static_cast<rlim_t>(1e6 * wanted) - mallinfo2().fordblks;
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

TEST_CASE("The BLAS library is identified") {
  CHECK_THAT(blas_description(), Catch::Contains("OpenBLAS"));
  CHECK_THAT(blas_description(), Catch::Contains("kernels for"));
}
