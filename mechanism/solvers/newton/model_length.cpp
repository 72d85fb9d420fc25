#include "mechanism/solvers/newton/model_length.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {
namespace {

constexpr double rounding = 1e-13;  ///< rounding of positions of the same point, relative to the size

}  // namespace

double model_length(const State& state) {
  double squared = 0;
  for (const NodeState& node : state.nodes) squared = std::max(squared, node.x.squaredNorm());
  const double length = std::sqrt(squared);
  return length > rounding ? length : 1;  // 1 if all nodes are at the origin
}

double spread(const State& state) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 1; i < state.nodes.size(); ++i) box.extend(state.nodes[i].x);
  const double length = state.nodes.size() > 1 ? box.diagonal().norm() : 0;
  return length > rounding * model_length(state) ? length : 0;
}

double model_extent(const State& state) {
  const double length = spread(state);
  return length > 0 ? length : model_length(state);
}

VectorX constraint_sizes(const System& system, const Environment& environment, const State& state) {
  const int first = system.size() - system.multipliers();
  const double length = model_length(state);
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, values);
  const SparsePattern& pattern = system.pattern();
  VectorX sizes = VectorX::Zero(system.multipliers());
  for (int column = 0; column < first; ++column)
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
         k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      if (const int row = pattern.row()[static_cast<std::size_t>(k)]; row >= first)
        sizes[row - first] +=
            std::abs(values[static_cast<std::size_t>(k)]) * (system.kind(column) == Kind::translation ? length : 1.0);
  return (sizes.array() > 0).select(sizes, 1.0);
}

double constraint_size(const System& system, const Environment& environment, const State& state, std::size_t member,
                       int row, double length) {
  const Slots& slots = system.slots()[member];
  const int n = slots.size();
  MatrixX K = MatrixX::Zero(n, n), C = K, M = K;
  LocalTangent tangent{LocalMatrix(K), LocalMatrix(C), LocalMatrix(M)};
  system.model().members()[member].component->add_tangent(LocalState(state, slots, environment), tangent);
  const bool holonomic = system.constraint_kind(slots.multiplier_begin + row) == ConstraintKind::holonomic;
  const VectorX B = (holonomic ? K : C).row(slots.multiplier_row() + row).head(slots.amplitude_row()).cwiseAbs();
  double size = 0;
  for (Eigen::Index k = 0; k < B.size(); k += 6) size += length * B.segment<3>(k).sum() + B.segment<3>(k + 3).sum();
  return size > 0 ? size : 1;
}

}  // namespace bielle::mechanism
