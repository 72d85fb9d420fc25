#include "mechanism/system/linearise.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = SystemMatrices::Sparse;

/// Extracts a submatrix of the whole tangent, of the entries for which `keep` is true; entries that are zero are
/// omitted.
template <class Keep>
Sparse part_of(const System& system, const std::vector<double>& values, int row_begin, int rows, int column_begin,
               int columns, const Keep& keep) {
  const SparsePattern& pattern = system.pattern();
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = column_begin; column < column_begin + columns; ++column)
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
         k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k) {
      const int row = pattern.row()[static_cast<std::size_t>(k)] - row_begin;
      const double value = values[static_cast<std::size_t>(k)];
      if (row >= 0 && row < rows && value != 0 && keep(row)) entries.emplace_back(row, column - column_begin, value);
    }
  Sparse part(rows, columns);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace

SystemMatrices linearise(const System& system, const Environment& environment, const State& state) {
  const int m = system.multipliers(), n = system.size() - m;
  std::vector<double> values;
  const auto take = [&](const TangentWeights& weights) {
    system.tangent(state, environment, weights, nullptr, values);
  };
  const auto any = [](int) { return true; };
  const auto nonholonomic = [&](int row) { return system.constraint_kind(row) == ConstraintKind::nonholonomic; };
  const auto upper = [&] { return part_of(system, values, 0, n, 0, n, any); };
  SystemMatrices matrices;
  take({1, 0, 0, 0, 0});
  matrices.K = upper();
  matrices.F = part_of(system, values, 0, n, n, m, any);
  take({0, 1, 0, 1, 0});
  matrices.C = upper();
  take({0, 0, 1, 0, 0});
  matrices.M = upper();
  take({1, 0, 0, 0, 1});  // includes the terms of B v due to carried nodes
  matrices.S = part_of(system, values, n, m, 0, n, nonholonomic);
  take({0, 0, 0, 0, 1, true});
  matrices.B = part_of(system, values, n, m, 0, n, any);
  return matrices;
}

}  // namespace bielle::mechanism
