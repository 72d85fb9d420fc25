#include <algorithm>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "reduce/spectral/arpack_eigenpairs.hpp"
#include "reduce/spectral/block_lanczos.hpp"
#include "tests/unit/reduce/sparse/laplacian.hpp"
#include "tests/unit/reduce/spectral/dense_pencil.hpp"

using namespace bielle;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::DensePencil;

namespace {

EigenpairOptions with_block(int block, int basis = 0) {
  EigenpairOptions options;
  options.method = EigenMethod::block_lanczos;
  options.block = block;
  options.basis = basis;
  return options;
}

EigenpairOptions by_arpack() {
  EigenpairOptions options;
  options.method = EigenMethod::arpack;
  return options;
}

/// Returns eigenvalues by the block method, for problems of any size, in ascending order.
VectorXd block_values(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) {
  VectorXd values = block_lanczos_eigenpairs(problem, count, options).values;
  std::sort(values.begin(), values.end());
  return values;
}

double difference(const VectorXd& a, const VectorXd& b) {
  REQUIRE(a.size() == b.size());
  return (a.array() / b.array() - 1).abs().maxCoeff();
}

/// Returns the relative error of the dense solver, a few eps of the largest nu, which is 1 / (least eigenvalue).
double dense_rounding(const VectorXd& values) { return 1e-14 * values(values.size() - 1) / values(0); }

}  // namespace

TEST_CASE("block Lanczos: multiplicities below, at and above the size of the block", "[spectral]") {
  // The eigenvalues of a cube are known in closed form and have multiplicities up to six.
  const SymmetricFactor factor(test::grid_laplacian({12, 12, 12}));
  const ShiftInvertProblem problem{factor.size(), 0, [&](const MatrixXd& b) { return factor.solve(b); },
                                   [](const MatrixXd& x) { return x; }};
  std::vector<double> exact;
  for (int i = 1; i <= 12; ++i)
    for (int j = 1; j <= 12; ++j)
      for (int k = 1; k <= 12; ++k)
        exact.push_back(test::grid_eigenvalue(i, 12) + test::grid_eigenvalue(j, 12) + test::grid_eigenvalue(k, 12));
  std::sort(exact.begin(), exact.end());
  for (const int block : {1, 2, 3, 5, 6, 8, 16}) {
    CAPTURE(block);
    const VectorXd values = block_values(problem, 40, with_block(block));
    CHECK(difference(values, Eigen::Map<const VectorXd>(exact.data(), 40)) < 1e-11);
  }
}

TEST_CASE("block Lanczos: multiplicities far above the number of columns of the block", "[spectral]") {
  VectorXd values(200);
  values << VectorXd::Constant(40, 2.0), VectorXd::LinSpaced(160, 3, 400);
  const DensePencil pencil{test::with_eigenvalues(values), MatrixXd::Identity(200, 200)};
  for (const int block : {1, 4, 8, 16}) {
    CAPTURE(block);
    CHECK(difference(block_values(pencil.problem(), 50, with_block(block)), values.head(50)) < 1e-11);
  }
}

TEST_CASE("block Lanczos: an exhausted Krylov space is replaced by a new one", "[spectral]") {
  // There are only three eigenvalues, so that any block spans an invariant space after three steps.
  VectorXd values(90);
  values << VectorXd::Constant(20, 1.0), VectorXd::Constant(30, 5.0), VectorXd::Constant(40, 25.0);
  const DensePencil pencil{test::with_eigenvalues(values), MatrixXd::Identity(90, 90)};
  for (const int block : {1, 6, 16}) {
    for (const int count : {3, 20, 45, 60, 90}) {
      CAPTURE(block, count);
      CHECK(difference(block_values(pencil.problem(), count, with_block(block)), values.head(count)) < 1e-11);
    }
  }
}

TEST_CASE("block Lanczos: two tuning forks on one base", "[spectral]") {
  // Two equal chains are connected by a spring of 1e-9, which makes pairs of nearly equal frequencies.
  VectorXd springs = VectorXd::Ones(401);
  springs(200) = 1e-9;
  const DensePencil pencil{test::chain_of_springs(springs), 0.5 * MatrixXd::Identity(400, 400)};
  const VectorXd exact = pencil.values().head(24);
  CHECK(exact(1) / exact(0) - 1 < 1e-4);
  for (const int block : {1, 4, 16}) {
    CAPTURE(block);
    const Eigenpairs pairs = shift_invert_eigenpairs(pencil.problem(), 24, with_block(block));
    CHECK(difference(pairs.values, exact) < dense_rounding(exact));
    CHECK(pencil.orthogonality(pairs) < 1e-11);
    CHECK(difference(pairs.values, shift_invert_eigenpairs(pencil.problem(), 24, by_arpack()).values) < 1e-12);
  }
}

TEST_CASE("block Lanczos: a free ring", "[spectral]") {
  // The eigenvalues are 4 sin^2(pi k / n), double except for k = 0; the shift is below zero.
  const Index n = 300;
  MatrixXd K = test::chain_of_springs(VectorXd::Ones(n + 1));
  K(0, n - 1) = K(n - 1, 0) = -1;
  const DensePencil pencil{K, MatrixXd::Identity(n, n), -1e-3};
  const Eigenpairs pairs = shift_invert_eigenpairs(pencil.problem(), 21, with_block(0));
  REQUIRE(pairs.values.size() == 21);
  for (Index k = 0; k < 21; ++k) {
    const double exact = 4 * std::pow(std::sin(std::numbers::pi * static_cast<double>((k + 1) / 2) / n), 2);
    CHECK_THAT(pairs.values(k), Catch::WithinAbs(exact, 1e-14 + 1e-12 * exact));  // K has errors of eps |K|
  }
  CHECK(pencil.orthogonality(pairs) < 1e-11);
}

TEST_CASE("block Lanczos: springs a million times stiffer than others", "[spectral]") {
  VectorXd springs(501);
  for (Index k = 0; k < springs.size(); ++k) springs(k) = (k / 50) % 2 == 0 ? 1 : 1e6;
  VectorXd masses = VectorXd::LinSpaced(500, 1, 3);
  const DensePencil pencil{test::chain_of_springs(springs), masses.asDiagonal()};
  const Eigenpairs pairs = shift_invert_eigenpairs(pencil.problem(), 30, with_block(0));
  const Eigenpairs reference = shift_invert_eigenpairs(pencil.problem(), 30, by_arpack());
  CHECK(difference(pairs.values, reference.values) < 1e-11);
  CHECK(difference(pairs.values, pencil.values().head(30)) < 1e-8);  // eps times 1e6 times the range of nu
  CHECK(pairs.residuals.maxCoeff() < 1e-9);
}

TEST_CASE("block Lanczos: a singular mass matrix", "[spectral]") {
  // Two of three degrees of freedom have no mass, so that 150 degrees of freedom have 50 eigenvalues.
  MatrixXd K = test::with_eigenvalues(VectorXd::LinSpaced(150, 1, 60));
  VectorXd masses = VectorXd::Zero(150);
  for (Index k = 0; k < 50; ++k) masses(3 * k) = 1 + 0.1 * static_cast<double>(k);
  const DensePencil pencil{K, masses.asDiagonal()};
  const VectorXd exact = pencil.values();
  REQUIRE(exact.size() == 50);
  for (const int count : {1, 10, 40, 50}) {
    CAPTURE(count);
    const Eigenpairs pairs = shift_invert_eigenpairs(pencil.problem(), count, with_block(0));
    CHECK(difference(pairs.values, exact.head(count)) < 1e-10);
    CHECK(pencil.residual(pairs) < 1e-9);
    CHECK(pencil.orthogonality(pairs) < 1e-11);
    CHECK(difference(block_values(pencil.problem(), count, with_block(8)), exact.head(count)) < 1e-10);
    const Eigenpairs chosen = shift_invert_eigenpairs(pencil.problem(), count);
    CHECK(difference(chosen.values, exact.head(count)) < 1e-10);
    CHECK(chosen.method == (count < 50 ? "ARPACK" : "block Lanczos"));
  }
  CHECK_THROWS_WITH(shift_invert_eigenpairs(pencil.problem(), 50, by_arpack()), Catch::Contains("block_lanczos"));
  // All eigenvalues are found if more are requested than exist.
  CHECK(difference(block_values(pencil.problem(), 70, with_block(8)), exact) < 1e-10);
  CHECK(
      block_values({150, 0, pencil.problem().solve, [](const MatrixXd& x) { return MatrixXd(0 * x); }}, 3, {}).size() ==
      0);
}

TEST_CASE("block Lanczos: problems smaller than a block, and all of their eigenvalues", "[spectral]") {
  for (const Index n : {1, 2, 5, 20, 33}) {
    const DensePencil pencil{test::with_eigenvalues(VectorXd::LinSpaced(n, 1, 9)), 2 * MatrixXd::Identity(n, n)};
    const VectorXd exact = VectorXd::LinSpaced(n, 1, 9) / 2;
    for (const Index count : {Index{1}, (n + 1) / 2, n, n + 7}) {
      CAPTURE(n, count);
      CHECK(difference(block_values(pencil.problem(), static_cast<int>(count), {}), exact.head(std::min(n, count))) <
            1e-12);
    }
  }
}

TEST_CASE("block Lanczos: restarts do not change the result", "[spectral]") {
  VectorXd springs = VectorXd::LinSpaced(401, 1, 2);
  // A distant shift makes all eigenvalues nu similar.
  const DensePencil pencil{test::chain_of_springs(springs), MatrixXd::Identity(400, 400), -2};
  const VectorXd exact = pencil.values().head(12);
  for (const int block : {1, 3, 8}) {
    CAPTURE(block);
    const Eigenpairs pairs = shift_invert_eigenpairs(pencil.problem(), 12, with_block(block, 60));
    CHECK(pairs.restarts > 0);
    CHECK((pairs.values - exact).cwiseAbs().maxCoeff() < 1e-13);
    CHECK(pencil.orthogonality(pairs) < 1e-11);
  }
}

TEST_CASE("block Lanczos: wide blocks need few passes over the factor", "[spectral]") {
  const SymmetricFactor factor(test::grid_laplacian({20, 19, 18}));
  int sweeps = 0, columns = 0, told = 0;
  const ShiftInvertProblem problem{factor.size(), 0,
                                   [&](const MatrixXd& b) {
                                     ++sweeps;
                                     columns += static_cast<int>(b.cols());
                                     return factor.solve(b);
                                   },
                                   [](const MatrixXd& x) { return x; }};
  EigenpairOptions options = with_block(16);
  options.on_solve = [&](int solves) { told = solves; };
  const Eigenpairs pairs = block_lanczos_eigenpairs(problem, 20, options);
  CHECK(pairs.sweeps == sweeps);
  CHECK(pairs.solves == columns);
  CHECK(told == columns);
  CHECK(sweeps < 20);
}

TEST_CASE("block Lanczos: the message about an iteration without convergence tells the number of converged modes",
          "[spectral]") {
  const DensePencil pencil{test::chain_of_springs(VectorXd::Ones(901)), MatrixXd::Identity(900, 900), -4};
  EigenpairOptions options = with_block(2, 30);
  options.restarts = 2;
  CHECK_THROWS_AS(block_lanczos_eigenpairs(pencil.problem(), 20, options), ComputationError);
  CHECK_THROWS_WITH(block_lanczos_eigenpairs(pencil.problem(), 20, options),
                    Catch::Contains("after 2 restarts") && Catch::Contains("of 20 modes converged"));
}

TEST_CASE("block Lanczos: several threads give the same result", "[spectral]") {
  const SymmetricFactor factor(test::grid_laplacian({30, 20, 15}));
  const ShiftInvertProblem problem{factor.size(), 0, [&](const MatrixXd& b) { return factor.solve(b); },
                                   [](const MatrixXd& x) { return x; }};
  EigenpairOptions two;
  two.threads = 2;
  CHECK(difference(block_values(problem, 10, {}), block_values(problem, 10, two)) < 1e-13);
}
