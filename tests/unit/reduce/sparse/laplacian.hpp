// Discrete Laplacians. Their eigenvalues are known in closed form.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::test {

/// Returns the second differences on a grid of n[0] x n[1] x n[2] points with zeros outside. The eigenvalues are sum_d
/// 4 sin^2(k_d pi / (2 (n_d + 1))), k_d = 1 .. n_d.
inline SymmetricMatrix grid_laplacian(std::array<int, 3> n) {
  SymmetricMatrix a;
  a.size = std::int64_t{n[0]} * n[1] * n[2];
  const double diagonal = 2.0 * ((n[0] > 1) + (n[1] > 1) + (n[2] > 1));
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::int64_t own = i + n[0] * (j + std::int64_t{n[1]} * k);
        a.rows.push_back(own);
        a.values.push_back(diagonal);
        const std::array<std::int64_t, 3> steps{1, n[0], std::int64_t{n[0]} * n[1]};
        const std::array<int, 3> place{i, j, k};
        for (int d = 0; d < 3; ++d) {
          if (place[d] + 1 < n[d]) {
            a.rows.push_back(own + steps[d]);
            a.values.push_back(-1);
          }
        }
        a.starts.push_back(static_cast<std::int64_t>(a.rows.size()));
      }
    }
  }
  return a;
}

inline double grid_eigenvalue(int k, int n) {
  return n == 1 ? 0 : 4 * std::pow(std::sin(k * std::numbers::pi / (2 * (n + 1))), 2);
}

}  // namespace bielle::test
