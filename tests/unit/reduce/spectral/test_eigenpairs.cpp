#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "reduce/spectral/eigenpairs.hpp"
#include "tests/unit/reduce/sparse/laplacian.hpp"

using namespace bielle;

namespace {

/// K = grid Laplacian - shift, M = mass times the identity.
struct GridProblem {
  std::array<int, 3> n;
  SymmetricFactor factor;
  double mass, shift;

  static SymmetricMatrix shifted(std::array<int, 3> n, double by) {
    SymmetricMatrix a = test::grid_laplacian(n);
    for (std::int64_t j = 0; j < a.size; ++j) {
      a.values[a.starts[j]] -= by;
    }
    return a;
  }
  explicit GridProblem(std::array<int, 3> points, double m = 1, double s = 0)
      : n(points), factor(shifted(points, s * m)), mass(m), shift(s) {}
  ShiftInvertProblem problem() const {
    return {factor.size(), shift, [this](const Eigen::MatrixXd& b) { return factor.solve(b); },
            [this](const Eigen::MatrixXd& x) { return Eigen::MatrixXd(mass * x); }};
  }
  /// Returns all eigenvalues in ascending order.
  std::vector<double> exact() const {
    std::vector<double> values;
    for (int i = 1; i <= n[0]; ++i) {
      for (int j = 1; j <= n[1]; ++j) {
        for (int k = 1; k <= n[2]; ++k) {
          values.push_back(
              (test::grid_eigenvalue(i, n[0]) + test::grid_eigenvalue(j, n[1]) + test::grid_eigenvalue(k, n[2])) /
              mass);
        }
      }
    }
    std::sort(values.begin(), values.end());
    return values;
  }
};

void check_pairs(const GridProblem& grid, const Eigenpairs& pairs) {
  const std::vector<double> exact = grid.exact();
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    // The factor belongs to a matrix that differs from K by a few eps |K|, |K| <= 12, and eigenvalues change by as
    // much.
    const double rounding = 10 * 12 * std::numeric_limits<double>::epsilon();
    CHECK_THAT(pairs.values(k) * grid.mass, Catch::WithinAbs(exact[k] * grid.mass, rounding + 1e-13 * exact[k]));
    CHECK(pairs.residuals(k) < 1e-8);
  }
  const Eigen::MatrixXd gram = pairs.vectors.transpose() * pairs.vectors * grid.mass;
  CHECK((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff() < 1e-10);
}

EigenpairOptions by(EigenMethod method) {
  EigenpairOptions options;
  options.method = method;
  return options;
}

const auto both_methods = {EigenMethod::arpack, EigenMethod::block_lanczos};

}  // namespace

TEST_CASE("The lowest eigenvalues of a chain are those of the closed form") {
  const GridProblem chain({2000, 1, 1}, 2.5);
  for (const EigenMethod method : both_methods) {
    const Eigenpairs pairs = shift_invert_eigenpairs(chain.problem(), 12, by(method));
    REQUIRE(pairs.values.size() == 12);
    check_pairs(chain, pairs);
    if (method == EigenMethod::block_lanczos) CHECK(pairs.sweeps < 12);
    CHECK(pairs.method == (method == EigenMethod::arpack ? "ARPACK" : "block Lanczos"));
  }
}

TEST_CASE("Every copy of a multiple eigenvalue is found") {
  const GridProblem cube({12, 12, 12});  // eigenvalues up to six times
  for (const EigenMethod method : both_methods) {
    const Eigenpairs pairs = shift_invert_eigenpairs(cube.problem(), 30, by(method));
    REQUIRE(pairs.values.size() == 30);
    check_pairs(cube, pairs);
  }
}

TEST_CASE("Eigenvalues far from the shift need restarts, and none is missed") {
  // All of them are close together relative to the shift, so that the best of a first subspace have not converged.
  const GridProblem cube({11, 11, 11}, 1, -4);
  for (const EigenMethod method : both_methods) {
    const Eigenpairs pairs = shift_invert_eigenpairs(cube.problem(), 11, by(method));
    CHECK(pairs.restarts > 0);
    REQUIRE(pairs.values.size() == 11);
    check_pairs(cube, pairs);
  }
}

TEST_CASE("If ARPACK does not converge, it is tried again in a space of twice the size") {
  const GridProblem cube({11, 11, 11}, 1, -4), farther({11, 11, 11}, 1, -400);
  EigenpairOptions options = by(EigenMethod::arpack);
  const Eigenpairs enough = shift_invert_eigenpairs(cube.problem(), 11, options);
  REQUIRE(enough.restarts > 4);
  options.restarts = enough.restarts / 2;
  const Eigenpairs pairs = shift_invert_eigenpairs(cube.problem(), 11, options);
  CHECK(pairs.solves > enough.solves);
  REQUIRE(pairs.values.size() == 11);
  check_pairs(cube, pairs);
  options.restarts = 1;
  CHECK_THROWS_WITH(shift_invert_eigenpairs(farther.problem(), 11, options), Catch::Contains("of 11 modes converged"));
}

TEST_CASE("The method is chosen by the numbers of unknowns and of pairs") {
  CHECK(sensible_method(100000, 61) == EigenMethod::arpack);
  CHECK(sensible_method(100001, 61) == EigenMethod::block_lanczos);
  CHECK(sensible_method(100000, 62) == EigenMethod::block_lanczos);
  const GridProblem plate({5, 4, 1});
  CHECK(shift_invert_eigenpairs(plate.problem(), 20).method == "dense algebra");
}

TEST_CASE("Small problems give all of their eigenvalues") {
  const GridProblem plate({5, 4, 1});
  const Eigenpairs pairs = shift_invert_eigenpairs(plate.problem(), 20);
  REQUIRE(pairs.values.size() == 20);
  check_pairs(plate, pairs);
}

TEST_CASE("A negative shift, which free bodies need, does not change the eigenvalues") {
  const GridProblem chain({500, 1, 1}, 1, -1e-4);
  const Eigenpairs pairs = shift_invert_eigenpairs(chain.problem(), 5);
  check_pairs(chain, pairs);
}

TEST_CASE("All eigenvalues below a limit are found") {
  const GridProblem cube({12, 11, 10});
  const std::vector<double> exact = cube.exact();
  const double limit = (exact[41] + exact[42]) / 2;
  const ShiftInvertProblem problem = cube.problem();
  const auto search = [&](int count) { return shift_invert_eigenpairs(problem, count); };
  const Eigenpairs pairs = eigenpairs_below(search, problem, limit, 5);
  REQUIRE(pairs.values.size() == 42);
  check_pairs(cube, pairs);
  CHECK(eigenpairs_below(search, problem, exact[0] / 2).values.size() == 0);
  CHECK_THROWS_AS(eigenpairs_below(search, problem, limit, 5, 20), InputError);
}

TEST_CASE("Constraints in the solution remove their directions from the spectrum") {
  // A constraint at the middle of a chain makes two chains of half the length, and doubles each eigenvalue.
  const GridProblem chain({801, 1, 1});
  const Eigen::VectorXd held = Eigen::VectorXd::Unit(801, 400);
  const Eigen::VectorXd influence = chain.factor.solve(held);
  ShiftInvertProblem problem = chain.problem();
  problem.solve = [&](const Eigen::MatrixXd& b) {
    Eigen::MatrixXd x = chain.factor.solve(b);
    x -= influence * (x.row(400) / influence(400));
    return x;
  };
  for (const EigenMethod method : both_methods) {
    const Eigenpairs pairs = shift_invert_eigenpairs(problem, 6, by(method));
    for (int k = 0; k < 6; ++k) {
      CHECK(pairs.values(k) == Approx(test::grid_eigenvalue(k / 2 + 1, 400)).epsilon(1e-11));
      CHECK(std::abs(pairs.vectors(400, k)) < 1e-12);
    }
  }
}

TEST_CASE("Vectors of one eigenvalue that an iteration leaves not quite orthogonal are made orthonormal") {
  // On a square grid, sin(i pi x) sin(j pi y) and sin(j pi x) sin(i pi y) have the same eigenvalue, and so have their
  // combinations. An iteration may return two vectors that are not orthogonal, and further solutions do not change
  // this.
  constexpr int points = 20;
  const GridProblem square({points, points, 1}, 2.5);
  constexpr double skew = 1e-4;
  const auto vector = [&](int i, int j) {
    Eigen::VectorXd phi(points * points);
    for (int y = 0; y < points; ++y) {
      for (int x = 0; x < points; ++x) {
        phi(x + points * y) = std::sin(i * std::numbers::pi * (x + 1) / (points + 1)) *
                              std::sin(j * std::numbers::pi * (y + 1) / (points + 1));
      }
    }
    return phi;
  };
  EigenpairOptions options;
  options.iteration = [&](const ShiftInvertProblem&, int count, const EigenpairOptions&) {
    Eigenpairs pairs;
    pairs.values = Eigen::VectorXd::Ones(count);
    pairs.vectors.resize(points * points, count);
    pairs.vectors << vector(1, 1), vector(1, 2), vector(2, 1) + skew * vector(1, 2);
    return pairs;
  };
  const Eigenpairs pairs = shift_invert_eigenpairs(square.problem(), 3, options);
  const std::vector<double> exact = square.exact();
  for (int k = 0; k < 3; ++k) {
    CHECK(pairs.values(k) == Approx(exact[k]).epsilon(1e-12));
  }
  // The correction V (I - E/2), with the small off-diagonal part E of the Gram matrix, leaves an error of the order of
  // E^2.
  const Eigen::MatrixXd gram = 2.5 * pairs.vectors.transpose() * pairs.vectors;
  CHECK((gram - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff() < 2 * skew * skew);
}

TEST_CASE("The message about an iteration without convergence tells the number of converged modes") {
  const GridProblem cube({12, 12, 12});
  EigenpairOptions options = by(EigenMethod::block_lanczos);
  options.restarts = 1;
  options.tolerance = 1e-14;
  CHECK_THROWS_WITH(shift_invert_eigenpairs(cube.problem(), 40, options), Catch::Contains("of 40 modes converged"));
}

TEST_CASE("The same problem gives the same numbers every time") {
  const GridProblem cube({9, 8, 7});
  const Eigenpairs first = shift_invert_eigenpairs(cube.problem(), 7);
  const Eigenpairs second = shift_invert_eigenpairs(cube.problem(), 7);
  CHECK(first.values == second.values);
  CHECK(first.vectors == second.vectors);
}
