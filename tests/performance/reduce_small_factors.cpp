// Small matrices: a dense factor against CHOLMOD's, to find the size below which the dense one takes less time.
//
//   reduce_small_factors
//
// Solids have 3 unknowns per grid point, which are coupled with those of up to 26 neighbours, as by tetrahedra. For
// each factor, the program prints the processor time [ms] of the factorisation with its structure, and of 200 solutions
// with one column, about the work for a reduction with modes. Nothing is asserted.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "reduce/sparse/dense_factor.hpp"
#include "reduce/sparse/symmetric_factor.hpp"

namespace {

using namespace bielle;

/// Returns the diagonally dominant matrix of a grid of n x n x length points.
SymmetricMatrix solid(int n, int length, std::vector<std::int64_t>& blocks) {
  SymmetricMatrix a;
  const int points = n * n * length;
  const auto place = [n](int p) { return std::array{p % n, p / n % n, p / (n * n)}; };
  a.size = 3 * points;
  for (int p = 0; p < points; ++p) {
    blocks.push_back(3 * p);
    for (int c = 0; c < 3; ++c) {
      for (int q = p; q < points; ++q) {
        const auto x = place(p), y = place(q);
        if (std::abs(x[0] - y[0]) > 1 || std::abs(x[1] - y[1]) > 1 || std::abs(x[2] - y[2]) > 1) continue;
        for (int d = q == p ? c : 0; d < 3; ++d) {
          a.rows.push_back(3 * q + d);
          a.values.push_back(q == p && d == c ? 100 : -0.5 / (1 + d + c));
        }
      }
      a.starts.push_back(static_cast<std::int64_t>(a.rows.size()));
    }
  }
  blocks.push_back(a.size);
  return a;
}

/// Returns the processor time [ms], the least of some.
template <class Work>
double milliseconds_of(const Work& work) {
  double least = 1e300;
  for (int round = 0; round < 9; ++round) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

void measure(int n, int length) {
  std::vector<std::int64_t> blocks;
  const SymmetricMatrix a = solid(n, length, blocks);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.size, 1);
  const auto solutions = [&](const Factor& factor) {
    return milliseconds_of([&] {
      for (int k = 0; k < 200; ++k) factor.solve(b);
    });
  };
  const double dense = milliseconds_of([&] { DenseFactor factor(a); }), dense_solutions = solutions(DenseFactor(a));
  const double sparse = milliseconds_of([&] { SymmetricFactor factor(a, blocks); }),
               sparse_solutions = solutions(SymmetricFactor(a, blocks));
  fmt::print("{:8} {:12.2f} {:12.2f} {:12.2f} {:12.2f} {:12.2f}\n", a.size, dense, sparse, dense_solutions,
             sparse_solutions, (dense + dense_solutions) / (sparse + sparse_solutions));
}

}  // namespace

int main() {
  fmt::print("{:>8} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "unknowns", "dense", "CHOLMOD", "200 dense", "200 CHOLMOD",
             "all, ratio");
  for (const auto& [n, length] : {std::pair{2, 3}, {3, 3}, {3, 6}, {3, 11}, {4, 8}, {4, 12}, {5, 10}, {5, 16}, {6, 18}})
    measure(n, length);
}
