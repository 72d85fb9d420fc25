#include "mechanism/solvers/redundancy.hpp"

#include <cmath>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "mechanism/math/rank.hpp"

namespace bielle::mechanism {

std::vector<int> find_redundant(const System& system, const Environment& environment, const State& state) {
  if (system.multipliers() == 0) return {};
  double length = 0;
  for (const NodeState& node : state.nodes) length = std::max(length, node.x.norm());
  if (length == 0) length = 1;
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, values);
  const SparsePattern& pattern = system.pattern();
  const int first = system.size() - system.multipliers();
  std::vector<Eigen::Triplet<double>> entries;
  for (int m = 0; m < system.multipliers(); ++m) {
    const auto begin = static_cast<std::size_t>(pattern.column_start()[static_cast<std::size_t>(first + m)]);
    const auto end = static_cast<std::size_t>(pattern.column_start()[static_cast<std::size_t>(first + m + 1)]);
    double norm = 0;
    const auto scaled = [&](std::size_t k) {
      // A translation's increment counts in lengths of the model.
      return values[k] * (system.kind(pattern.row()[k]) == Kind::translation ? length : 1.0);
    };
    for (std::size_t k = begin; k < end; ++k) norm += scaled(k) * scaled(k);
    norm = std::sqrt(norm);
    for (std::size_t k = begin; k < end; ++k)
      if (norm > 0 && pattern.row()[k] < first && values[k] != 0)
        entries.emplace_back(pattern.row()[k], m, scaled(k) / norm);
  }
  Eigen::SparseMatrix<double> transposed(first, system.multipliers());
  transposed.setFromTriplets(entries.begin(), entries.end());
  // Far above rounding, far below what a loop that is nearly planar leaves.
  constexpr double tolerance = 1e-9;
  return dependent_columns(transposed, tolerance);
}

void check_set_aside(const System& system, const Environment& environment, const State& state) {
  if (system.set_aside().empty()) return;
  // Rounding and Newton's tolerance leave far less; a contradiction shows at once.
  constexpr double tolerance = 1e-6;
  double length = 0;
  for (const NodeState& node : state.nodes) length = std::max(length, node.x.norm());
  std::size_t member = 0;
  VectorX r;
  for (const int multiplier : system.set_aside()) {
    while (multiplier >= system.slots()[member].multiplier_begin + system.slots()[member].multipliers) ++member;
    const Slots& slots = system.slots()[member];
    r.setZero(slots.size());
    system.model().members()[member].component->add_residual(LocalState(state, slots, environment), r);
    const double violation = r[slots.multiplier_row() + multiplier - slots.multiplier_begin];
    const int equation = system.size() - system.multipliers() + multiplier;
    const bool is_length = system.equation_units(equation) == "m";
    if (std::abs(violation) <= tolerance * (is_length ? length : 1.0)) continue;
    throw ComputationError(
        fmt::format("t = {:.6g} s: {} looked redundant at the start and was set aside, but is violated by {:.3g} {}: "
                    "it contradicts the "
                    "joints and drives before it",
                    state.time, system.equation_name(equation), violation, system.equation_units(equation)));
  }
}

}  // namespace bielle::mechanism
