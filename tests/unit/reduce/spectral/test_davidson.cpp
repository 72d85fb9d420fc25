#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/spectral/block_lanczos.hpp"
#include "reduce/spectral/davidson.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/unit/reduce/spectral/laplacian.hpp"

using namespace bielle;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// K of a grid, a mass that varies, and the factor of K with `extra` times its diagonal added in every third unknown as
/// the preconditioner.
struct Grid {
  SymmetricMatrix stiffness;
  SymmetricFactor exact, near;
  VectorXd mass;

  Grid(std::array<int, 3> points, double extra, bool is_even)
      : stiffness(test::grid_laplacian(points)),
        exact(stiffness),
        near(spoilt(stiffness, extra)),
        mass(VectorXd::LinSpaced(stiffness.size, 1, is_even ? 1 : 3)) {}

  ShiftInvertProblem problem() const {
    ShiftInvertProblem result{stiffness.size, 0, [&](const MatrixXd& b) { return exact.solve(b); },
                              [&](const MatrixXd& x) { return MatrixXd(mass.asDiagonal() * x); }};
    result.multiply_stiffness = [&](const MatrixXd& x) { return MatrixXd(stiffness.multiply(x)); };
    result.precondition = [&](const MatrixXd& b) { return near.solve(b); };
    return result;
  }

 private:
  static SymmetricMatrix spoilt(SymmetricMatrix a, double extra) {
    for (std::int64_t j = 0; j < a.size; j += 3) a.values[static_cast<std::size_t>(a.starts[j])] *= 1 + extra;
    return a;
  }
};

VectorXd lowest(const Grid& grid, int count) {
  ShiftInvertProblem problem = grid.problem();
  problem.precondition = nullptr;
  return shift_invert_eigenpairs(problem, count).values;
}

}  // namespace

TEST_CASE("Davidson: the pairs of block Lanczos, however rough the preconditioner", "[spectral]") {
  const double extra = GENERATE(0.0, 1e-4, 1e-2, 0.3);
  const int count = GENERATE(1, 9, 21, 60);
  CAPTURE(extra, count);
  const Grid grid({21, 19, 11}, extra, false);
  const ShiftInvertProblem problem = grid.problem();
  const Eigenpairs found = shift_invert_eigenpairs(problem, count);
  REQUIRE(found.values.size() == count);
  CHECK((found.values.array() / lowest(grid, count).array() - 1).abs().maxCoeff() < 1e-12);
  CHECK(found.residuals.maxCoeff() <= EigenpairOptions().tolerance);
  const MatrixXd gram = found.vectors.transpose() * problem.multiply_mass(found.vectors);
  CHECK((gram - MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff() < 1e-12);
  const MatrixXd error =
      found.vectors - grid.exact.solve(problem.multiply_mass(found.vectors)) * found.values.asDiagonal();
  CHECK(error.colwise().norm().maxCoeff() < 2e-8);
}

TEST_CASE("Davidson: with K^-1 as preconditioner it takes no more vectors than block Lanczos", "[spectral]") {
  const Grid grid({21, 19, 11}, 0, false);
  ShiftInvertProblem problem = grid.problem();
  const Eigenpairs davidson = davidson_eigenpairs(problem, 21, {});
  const Eigenpairs lanczos = block_lanczos_eigenpairs(problem, 21, {});
  CHECK(davidson.solves <= lanczos.solves + 21 + 16);  // the check of all, and a block in which few were left
}

TEST_CASE("Davidson: bases that are restarted", "[spectral]") {
  const Grid grid({21, 19, 11}, 1e-2, false);
  EigenpairOptions options;
  options.basis = 45;
  const Eigenpairs found = shift_invert_eigenpairs(grid.problem(), 12, options);
  CHECK(found.restarts > 0);
  CHECK((found.values.array() / lowest(grid, 12).array() - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("Davidson: multiplicities up to the block, at it and above it", "[spectral]") {
  // A cube: eigenvalues up to six times, by closed form.
  const int block = GENERATE(2, 3, 6, 8);
  CAPTURE(block);
  const Grid grid({12, 12, 12}, 1e-3, true);
  std::vector<double> exact;
  const auto of = [](int i) { return 2 - 2 * std::cos(std::numbers::pi * i / 13); };
  for (int i = 1; i <= 12; ++i)
    for (int j = 1; j <= 12; ++j)
      for (int k = 1; k <= 12; ++k) exact.push_back(of(i) + of(j) + of(k));
  std::sort(exact.begin(), exact.end());
  EigenpairOptions options;
  options.block = block;
  const Eigenpairs found = shift_invert_eigenpairs(grid.problem(), 30, options);
  for (Index k = 0; k < 30; ++k) CHECK(found.values(k) == Approx(exact[static_cast<std::size_t>(k)]).epsilon(1e-12));
}

TEST_CASE("Davidson: what cannot be found is said", "[spectral]") {
  const Grid grid({12, 11, 10}, 0.3, false);
  ShiftInvertProblem problem = grid.problem();
  problem.precondition = [](const MatrixXd& b) { return b; };  // creeps
  EigenpairOptions options;
  options.restarts = 3;
  options.basis = 60;
  CHECK_THROWS_AS(shift_invert_eigenpairs(problem, 21, options), ComputationError);
}
