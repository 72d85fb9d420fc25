// Every implementation of `Factor` must pass these checks. CHOLMOD's and the dense one run them in test_factors.cpp,
// MUMPS's in distributed/ranks/test_mumps_factor.cpp, a program of its own.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/sparse/factor.hpp"
#include "tests/unit/reduce/sparse/laplacian.hpp"

namespace bielle::test {

struct FactorKind {
  std::string name;
  std::function<std::unique_ptr<Factor>(const SymmetricMatrix& a, int threads)> make;
  bool counts_signs = true;
};

inline SymmetricMatrix one_unknown(double value) { return sparse_lower(Eigen::MatrixXd::Constant(1, 1, value)); }

inline SymmetricMatrix shifted(SymmetricMatrix a, double shift) {
  for (std::int64_t j = 0; j < a.size; ++j)
    a.values[static_cast<std::size_t>(a.starts[static_cast<std::size_t>(j)])] -= shift;
  return a;
}

/// Returns springs in a row with free ends, which can move as a whole, and separate masses on springs to the ground.
inline SymmetricMatrix floating_row(int springs, int held) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(springs + 1 + held, springs + 1 + held);
  a.topLeftCorner(springs + 1, springs + 1).setZero();
  for (int k = 0; k < springs; ++k) a.block<2, 2>(k, k) += 0.7 * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  return sparse_lower(a);
}

/// Numbers of points of grids, from chains to solids, all of them small enough for a dense factor.
inline const std::vector<std::array<int, 3>> factor_grids{{700, 1, 1}, {25, 24, 1}, {9, 8, 8}, {2, 2, 2}};

inline void check_solutions(const FactorKind& kind) {
  for (const auto& n : factor_grids) {
    const SymmetricMatrix a = grid_laplacian(n);
    const Eigen::MatrixXd exact = Eigen::MatrixXd::Random(a.size, 40), b = a.multiply(exact);
    // The condition number of a chain of 700 is 2e5, and that of the others is below 1000.
    const double tolerance = n[0] == 700 ? 1e-9 : 1e-12;
    std::vector<Eigen::MatrixXd> with_threads;
    for (const int threads : {1, 2}) {
      const std::unique_ptr<Factor> factor = kind.make(a, threads);
      for (const int columns : {1, 3, 16, 17, 40}) {
        CAPTURE(kind.name, n, threads, columns);
        const Eigen::MatrixXd x = factor->solve(b.leftCols(columns));
        REQUIRE(x.rows() == a.size);
        REQUIRE(x.cols() == columns);
        CHECK((x - exact.leftCols(columns)).norm() < tolerance * exact.leftCols(columns).norm());
        CHECK(factor->solve(b.leftCols(columns)) == x);  // a second use gives the same factor
        if (columns == 40) with_threads.push_back(x);
      }
    }
    CHECK((with_threads[0] - with_threads[1]).norm() < tolerance * exact.norm());
  }
}

inline void check_no_columns_and_one_unknown(const FactorKind& kind) {
  CAPTURE(kind.name);
  const SymmetricMatrix grid = grid_laplacian({5, 4, 3});
  CHECK(kind.make(grid, 1)->solve(Eigen::MatrixXd(60, 0)).rows() == 60);
  CHECK(kind.make(grid, 2)->solve(Eigen::MatrixXd(60, 0)).cols() == 0);
  const std::unique_ptr<Factor> factor = kind.make(one_unknown(4), 2);
  CHECK(factor->size() == 1);
  CHECK(factor->solve(Eigen::MatrixXd::Constant(1, 3, 2)) == Eigen::MatrixXd::Constant(1, 3, 0.5));
}

inline void check_statistics(const FactorKind& kind) {
  for (const auto& n : factor_grids) {
    CAPTURE(kind.name, n);
    const SymmetricMatrix a = grid_laplacian(n);
    const std::unique_ptr<Factor> factor = kind.make(a, 1);
    const FactorStatistics& statistics = factor->statistics();
    CHECK(statistics.unknowns == a.size);
    CHECK(factor->size() == a.size);
    CHECK(statistics.nonzeros >= static_cast<std::int64_t>(a.values.size()));  // the pattern of L contains that of A
    CHECK(statistics.nonzeros <= a.size * (a.size + 1));
    CHECK(statistics.flops > 0);
    CHECK(statistics.estimated_MB >= 0);
    CHECK(statistics.memory_MB() > 0);
    CHECK(statistics.seconds() > 0);
    CHECK(statistics.factorisation_seconds <= statistics.seconds());
  }
}

/// Checks that two factors of different matrices can be used alternately.
inline void check_two_at_a_time(const FactorKind& kind) {
  CAPTURE(kind.name);
  const SymmetricMatrix a = grid_laplacian({6, 5, 4}), b = shifted(grid_laplacian({9, 7, 1}), -0.5);
  const Eigen::MatrixXd xa = Eigen::MatrixXd::Random(a.size, 5), xb = Eigen::MatrixXd::Random(b.size, 5);
  const std::unique_ptr<Factor> of_a = kind.make(a, 1), of_b = kind.make(b, 1);
  for (int turn = 0; turn < 3; ++turn) {
    CHECK((of_a->solve(a.multiply(xa)) - xa).norm() < 1e-12 * xa.norm());
    CHECK((of_b->solve(b.multiply(xb)) - xb).norm() < 1e-12 * xb.norm());
  }
}

/// Returns the message with which a matrix is refused, or an empty one.
inline std::string refusal(const FactorKind& kind, const SymmetricMatrix& a, int threads) {
  try {
    kind.make(a, threads);
  } catch (const ComputationError& error) {
    return error.what();
  }
  return "";
}

inline void check_refusals(const FactorKind& kind) {
  SymmetricMatrix zero_diagonal = grid_laplacian({5, 5, 5}), negative = grid_laplacian({30, 20, 1});
  zero_diagonal.values[static_cast<std::size_t>(zero_diagonal.starts[61])] = 0;
  negative.values[static_cast<std::size_t>(negative.starts[300])] = 0.5;
  const auto middle = [](int k, int n) { return (grid_eigenvalue(k, n) + grid_eigenvalue(k + 1, n)) / 2; };
  for (const int threads : {1, 2}) {
    CAPTURE(kind.name, threads);
    for (const SymmetricMatrix& a : {floating_row(1, 1), floating_row(60, 0), floating_row(60, 20), zero_diagonal,
                                     negative, shifted(grid_laplacian({80, 1, 1}), middle(3, 80)), one_unknown(-2)}) {
      CAPTURE(a.size);
      const std::string said = refusal(kind, a, threads);
      CHECK_THAT(said, Catch::Contains("not positive definite") || Catch::Contains("singular"));
      CHECK(said.find(' ') != std::string::npos);
    }
    CHECK(refusal(kind, grid_laplacian({80, 1, 1}), threads).empty());
  }
}

/// Returns the eigenvalues of a grid in ascending order.
inline std::vector<double> grid_eigenvalues(const std::array<int, 3>& n) {
  std::vector<double> values;
  for (int i = 1; i <= n[0]; ++i)
    for (int j = 1; j <= n[1]; ++j)
      for (int k = 1; k <= n[2]; ++k)
        values.push_back(grid_eigenvalue(i, n[0]) + grid_eigenvalue(j, n[1]) + grid_eigenvalue(k, n[2]));
  std::sort(values.begin(), values.end());
  return values;
}

/// Returns a shift in the widest gap between some eigenvalues, and the number of eigenvalues below it.
inline std::pair<double, std::int64_t> shift_in_gap(const std::vector<double>& exact, double part) {
  const auto from = static_cast<std::size_t>(part * static_cast<double>(exact.size() - 1));
  std::size_t at = from;
  for (std::size_t k = from; k + 1 < std::min(from + 40, exact.size()); ++k)
    if (at + 1 == exact.size() || exact[k + 1] - exact[k] > exact[at + 1] - exact[at]) at = k;
  const double shift = at + 1 < exact.size() ? (exact[at] + exact[at + 1]) / 2 : exact[at] + 1;
  return {shift, static_cast<std::int64_t>(at) + 1};
}

constexpr double sound_growth = 1e6;  // limit of a reliable count (reduction/missed_modes.cpp)

inline void check_signs(const FactorKind& kind) {
  if (!kind.counts_signs) {
    CHECK_FALSE(kind.make(one_unknown(1), 1)->count_signs(one_unknown(-3), {1.0}));
    return;
  }
  CAPTURE(kind.name);
  for (const auto& n : factor_grids) {
    const SymmetricMatrix a = grid_laplacian(n);
    const std::vector<double> exact = grid_eigenvalues(n), scale(static_cast<std::size_t>(a.size), a.values[0]);
    const std::unique_ptr<Factor> factor = kind.make(a, 1);
    const PivotSigns definite = *factor->count_signs(a, scale);
    CHECK(definite.negative == 0);
    CHECK(definite.growth < sound_growth);
    for (const double part : {0.0, 0.001, 0.03, 0.3, 1.0}) {
      if (n[0] == 2 && part > 0.01 && part < 1) continue;  // the shift would equal its diagonal entry
      const auto [shift, below] = shift_in_gap(exact, part);
      CAPTURE(n, part, shift);
      const PivotSigns signs = *factor->count_signs(shifted(a, shift), scale);
      CHECK(signs.growth < sound_growth);
      CHECK(signs.negative == below);
    }
  }
  CHECK(kind.make(one_unknown(1), 1)->count_signs(one_unknown(-3), {1.0})->negative == 1);
}

/// A condition holds the chain at its middle, which makes two chains of half the length and doubles each eigenvalue.
/// The multiplier of the condition adds a negative eigenvalue.
inline void check_signs_with_a_border(const FactorKind& kind) {
  if (!kind.counts_signs) return;
  const int n = 601;
  const SymmetricMatrix chain = grid_laplacian({n, 1, 1});
  const std::unique_ptr<Factor> factor = kind.make(chain, 1);
  for (int k = 1; k < 20; ++k) {
    CAPTURE(kind.name, k);
    const double shift = (grid_eigenvalue(k, 300) + grid_eigenvalue(k + 1, 300)) / 2;
    const SymmetricMatrix a =
        bordered(shifted(chain, shift), Eigen::VectorXd::Unit(n, 300), Eigen::MatrixXd::Zero(1, 1));
    const PivotSigns signs = *factor->count_signs(a, std::vector<double>(static_cast<std::size_t>(n + 1), 2.0));
    CHECK(signs.growth < sound_growth);
    CHECK(signs.negative == 2 * k + 1);
  }
}

/// A shift at an eigenvalue causes a pivot whose sign cannot be determined.
inline void check_lost_signs(const FactorKind& kind) {
  if (!kind.counts_signs) return;
  CAPTURE(kind.name);
  const std::vector<double> two(2, 1.0);
  const std::unique_ptr<Factor> pair = kind.make(sparse_lower(Eigen::MatrixXd::Identity(2, 2)), 1);
  CHECK(pair->count_signs(sparse_lower(Eigen::MatrixXd::Constant(2, 2, 1)), two)->growth > sound_growth);
  CHECK(pair->count_signs(sparse_lower(Eigen::MatrixXd::Zero(2, 2)), two)->growth > sound_growth);
}

inline void check_all(const FactorKind& kind) {
  SECTION("solutions, of blocks of columns, again and with other threads") { check_solutions(kind); }
  SECTION("no columns, one unknown") { check_no_columns_and_one_unknown(kind); }
  SECTION("statistics") { check_statistics(kind); }
  SECTION("two at a time") { check_two_at_a_time(kind); }
  SECTION("refusals") { check_refusals(kind); }
  SECTION("signs of pivots") { check_signs(kind); }
  SECTION("signs with a border") { check_signs_with_a_border(kind); }
  SECTION("signs that are lost") { check_lost_signs(kind); }
}

}  // namespace bielle::test
