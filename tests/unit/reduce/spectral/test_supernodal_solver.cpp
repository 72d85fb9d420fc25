#include <array>

#include <catch2/catch.hpp>
#include <omp.h>

#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/unit/reduce/spectral/laplacian.hpp"

using namespace bielle;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Largest |A x - b| over |A| |x| + |b|, |A| <= 12: of the order of eps, what a backward stable solution leaves.
double residual(const SymmetricMatrix& a, const MatrixXd& x, const MatrixXd& b) {
  return (MatrixXd(a.multiply(x)) - b).cwiseAbs().maxCoeff() / (12 * x.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("supernodal solver: any shape of matrix, number of columns and of threads", "[spectral]") {
  // From chains, whose elimination trees are narrow, to solids, with wide supernodes at the top; several trees at last.
  for (const auto& n : {std::array{3000, 1, 1}, {120, 90, 1}, {17, 16, 15}, {2, 2, 2}, {1, 1, 1}}) {
    SymmetricMatrix a = test::grid_laplacian(n);
    if (a.size == 1) a.values[0] = 3;
    for (const int threads : {1, 2, 5}) {
      const SymmetricFactor factor(a, {}, threads);
      for (const int columns : {4, 7, 16, 130}) {
        CAPTURE(n, threads, columns);
        const MatrixXd b = MatrixXd::Random(a.size, columns);
        const MatrixXd x = factor.solve(b);
        CHECK(residual(a, x, b) < 1e-14);
        CHECK(factor.solve(b) == x);
      }
    }
  }
}

TEST_CASE("supernodal solver: matrices of several independent parts", "[spectral]") {
  const SymmetricMatrix part = test::grid_laplacian({9, 10, 11});
  SymmetricMatrix a;
  for (int copy = 0; copy < 3; ++copy) {
    const std::int64_t before = a.size, entries = a.starts.back();
    a.size += part.size;
    for (const std::int64_t row : part.rows) a.rows.push_back(row + before);
    a.values.insert(a.values.end(), part.values.begin(), part.values.end());
    for (std::size_t k = 1; k < part.starts.size(); ++k) a.starts.push_back(entries + part.starts[k]);
  }
  const MatrixXd b = MatrixXd::Random(a.size, 9);
  CHECK(residual(a, SymmetricFactor(a, {}, 2).solve(b), b) < 1e-14);
}

TEST_CASE("supernodal solver: where no second thread is to be had, one does all", "[spectral]") {
  const SymmetricMatrix a = test::grid_laplacian({20, 19, 18});
  const SymmetricFactor factor(a, {}, 2);
  const MatrixXd b = MatrixXd::Random(a.size, 8), x = factor.solve(b);
  const int before = omp_get_max_active_levels();
  omp_set_max_active_levels(1);
  std::array<MatrixXd, 2> inside;
#pragma omp parallel for num_threads(2)
  for (int k = 0; k < 2; ++k) inside[static_cast<std::size_t>(k)] = factor.solve(b);
  omp_set_max_active_levels(before);
  CHECK(inside[0] == x);
  CHECK(inside[1] == x);
}
