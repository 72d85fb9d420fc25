#include "mechanism/joints/measured_pair.hpp"

namespace bielle::mechanism {

MeasuredPair::MeasuredPair(std::string type, std::string name, JointFrames frames,
                           std::vector<JointCoordinate> coordinates, std::vector<Row> rows, const Model& model)
    : Joint(std::move(type), std::move(name), std::move(frames), std::move(coordinates), model),
      rows_(std::move(rows)) {}

void MeasuredPair::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = declaration.in_blocks = true;
  for (const Row& row : rows_) {
    declaration.multipliers.push_back({row.name, row.units, 0, row.kind});
    if (row.kind == ConstraintKind::nonholonomic) declaration.damping = true;
  }
}

std::span<const PairMeasure> MeasuredPair::calc(const LocalState& state, Rows& memory) const {
  const std::span<PairMeasure> declared(memory.data(), rows_.size());
  calc_rows(state, declared);
  return declared;
}

void MeasuredPair::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const auto lambda = state.multiplier();
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  std::array<PairSlope, 6> memory;
  const std::span<PairSlope> rows(memory.data(), rows_.size());
  calc_row_slopes(state, rows);
  Eigen::Index k = 0;
  for (const PairSlope& row : rows) {
    r.head<12>() += lambda[k] * row.gradient;
    const bool holonomic = rows_[static_cast<std::size_t>(k)].kind == ConstraintKind::holonomic;
    r[12 + k] += holonomic ? row.value : row.rate(v);
    ++k;
  }
}

void MeasuredPair::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const auto lambda = state.multiplier();
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  Matrix12 forces = Matrix12::Zero();
  Rows memory;
  int k = 0;
  for (const PairMeasure& row : calc(state, memory)) {
    const bool holonomic = rows_[static_cast<std::size_t>(k)].kind == ConstraintKind::holonomic;
    const int at = 12 + k;
    forces += lambda[k] * row.second;
    const Vector12 by_position = holonomic ? row.gradient : Vector12(row.second.transpose() * v);
    for (const int column : {0, 3, 6, 9}) {
      const Vector3 gradient = row.gradient.segment<3>(column);
      if (tangent.wants_K) {
        tangent.K.add_column(column, at, gradient);
        tangent.K.add_row(at, column, by_position.segment<3>(column));
      }
      if (tangent.wants_C && !holonomic) tangent.C.add_row(at, column, gradient);
    }
    ++k;
  }
  if (!tangent.wants_K) return;
  for (const int row : {0, 3, 6, 9})
    for (const int column : {0, 3, 6, 9}) tangent.K.add(row, column, forces.block<3, 3>(row, column));
}

void MeasuredPair::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                        Eigen::Ref<VectorX> acceleration) const {
  const Vector12 v = pair_rate(state.node(0), state.node(1)), a = pair_acceleration(state.node(0), state.node(1));
  Rows memory;
  Eigen::Index k = 0;
  for (const PairMeasure& row : calc(state, memory)) {
    velocity[k] += row.rate(v);
    acceleration[k] += row.acceleration(v, a);
    ++k;
  }
}

}  // namespace bielle::mechanism
