#include "mechanism/solvers/statics/held_coordinates.hpp"

#include <algorithm>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/start_rates.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {

HeldCoordinates::HeldCoordinates(const System& system, const Environment& environment, const State& state,
                                 const std::vector<CoordinateCondition>& held)
    : system_(system) {
  std::vector<VectorX> rows;
  for (const CoordinateCondition& each : held) {
    rows.push_back(VectorX::Zero(system.dofs()));
    for (const auto& [dof, value] :
         coordinate_row(system, environment, state, each.member, each.coordinate).by_position)
      rows.back()[dof] += value;
  }
  const std::vector<bool> dependent = dependent_rows(system, environment, state, rows);
  for (std::size_t k = 0; k < held.size(); ++k)
    if (!dependent[k]) held_.push_back(held[k]);
  constexpr double rounding = 1e-12;
  const auto count = static_cast<Eigen::Index>(held_.size());
  close_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k)
    close_[k] = rounding *
                (start_coordinate(system, held_[static_cast<std::size_t>(k)]).units == "m" ? model_length(state) : 1.0);
  HeldCoordinates::begin();
}

void HeldCoordinates::begin() { mu_ = base_ = change_ = VectorX::Zero(static_cast<Eigen::Index>(held_.size())); }

void HeldCoordinates::add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r) {
  const auto count = static_cast<Eigen::Index>(held_.size());
  W_.setZero(system_.dofs(), count);
  gap_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const CoordinateCondition& each = held_[static_cast<std::size_t>(k)];
    const CoordinateRow row = coordinate_row(system_, environment, state, each.member, each.coordinate);
    for (const auto& [dof, value] : row.by_position) W_(dof, k) += value;
    gap_[k] = coordinate_distance(start_coordinate(system_, each), row.value, *each.value);
  }
  r.head(system_.dofs()) += W_ * mu_;
}

/// Subtracts Z dmu from a solution without it. @returns dmu
VectorX HeldCoordinates::eliminate(const StaticTangent& tangent, const VectorX& gap, Eigen::Ref<VectorX> delta) const {
  const int n = system_.dofs();
  const Eigen::Index count = W_.cols();
  MatrixX Z(system_.size(), count);
  VectorX r = VectorX::Zero(system_.size()), z(system_.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    r.head(n) = -W_.col(k);
    tangent.solve(r, z);
    Z.col(k) = z;
  }
  const MatrixX S = W_.transpose() * Z.topRows(n);
  const std::optional<MatrixX> inverse = regular_inverse(S);
  if (!inverse) throw ComputationError("the coordinates to hold do not move independently of each other here");
  const VectorX change = *inverse * VectorX(W_.transpose() * delta.head(n) + gap);
  delta -= Z * change;
  return change;
}

void HeldCoordinates::solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                            Eigen::Ref<VectorX> delta) {
  tangent.solve(r, delta);
  if (!any()) return;
  change_ = eliminate(tangent, gap_, delta);
  base_ = mu_;
}

void HeldCoordinates::solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                                  Eigen::Ref<VectorX> delta) const {
  tangent.solve(r, delta);
  if (any()) eliminate(tangent, VectorX::Zero(gap_.size()), delta);
}

void HeldCoordinates::move(State& /*state*/, double part) {
  if (any()) mu_ = base_ + part * change_;
}

}  // namespace bielle::mechanism
