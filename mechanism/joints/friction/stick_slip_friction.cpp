#include "mechanism/joints/friction/stick_slip_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bielle::mechanism {
namespace {
enum StickSlipCrossing { comes_to_rest, begins_to_slip };
}

void StickSlipFriction::declare(Declaration& declaration) const {
  JointFriction::declare(declaration);
  const std::string& name = joint().coordinates()[surface().parts.back().coordinate].name;
  Declaration::Scalar row{"sticking " + name, "N", 0, ConstraintKind::nonholonomic};
  row.switched = true;
  declaration.multipliers.push_back(std::move(row));
  declaration.memory = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
  declaration.crossings = {{name + " sticks", Crossing::Direction::falling},
                           {name + " slips", Crossing::Direction::falling}};
  for (Crossing& each : declaration.crossings) each.begins_on = 1;  // what cannot stick slips at once
}

double StickSlipFriction::direction(const LocalState& state) {
  const double kept = state.memory()[0];
  return std::isnan(kept) || state.environment().statics ? 0 : kept;
}

bool StickSlipFriction::is_on(const LocalState& state, int /*row*/) const {
  return !state.environment().statics && state.memory()[0] == 0;
}

JointFriction::Resistance StickSlipFriction::resistance(const LocalState& state, const Vector& v) const {
  const double dir = direction(state);
  Resistance result{Vector::Zero(1), Matrix::Zero(1, 1), {}};
  if (dir == 0) return result;
  const auto [mu, slope] = law().level(v[0]);
  result.rho[0] = dir * mu + law().viscous * v[0];
  result.by_v(0, 0) = dir * slope * v[0] + law().viscous;
  return result;
}

JointFriction::Vector StickSlipFriction::held(const LocalState& state) const {
  return Vector::Constant(1, state.multiplier()[0]);
}

void StickSlipFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  JointFriction::add_residual(state, r);
  r[0] += velocity(state)[0];
}

void StickSlipFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  JointFriction::add_tangent(state, tangent);
  const Slip& s = slip(state, true);
  const int at = row(state), n = static_cast<int>(s.w.rows());
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.block(at, 0, n, 1) += s.w;
    K.block(0, at, 1, n) += s.by_position.transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(0, at, 1, n) += s.w.transpose();
}

void StickSlipFriction::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                             Eigen::Ref<VectorX> acceleration) const {
  const Slip& s = slip(state, true);
  const LocalState of_joint = state.of(0);
  VectorX v(s.w.rows()), a(s.w.rows());
  get_local_velocities(of_joint, v);
  get_local_accelerations(of_joint, a);
  velocity[0] += s.v[0];
  acceleration[0] += s.w.col(0).dot(a) + s.by_position.col(0).dot(v);
}

void StickSlipFriction::add_reaction_norm(const LocalState& /*state*/, double /*arm*/, Eigen::Ref<MatrixX> H) const {
  H(0, 0) += 1;
}

double StickSlipFriction::no_velocity(const LocalState& state) const {
  const LocalState of_joint = state.of(0);
  const NodeState &first = of_joint.node(0), &second = of_joint.node(1);
  double arm = 0;
  for (const FrictionSurface::Part& part : surface().parts) arm = std::max(arm, std::abs(part.arm));
  return 1e-12 * (first.v.norm() + second.v.norm() + arm * (first.Omega.norm() + second.Omega.norm()));
}

bool StickSlipFriction::came_to_rest(const LocalState& state, double v) const {
  return direction(state) != 0 && !has_slipped(state) && state.time() > state.memory()[2] && direction(state) * v <= 0;
}

void StickSlipFriction::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (direction(state) * velocity(state)[0] > 0) memory[1] = 1;
}

void StickSlipFriction::calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const double dir = direction(state);
  values.setOnes();
  // Just after it has begun to slip its velocity is rounding.
  if (dir != 0 && has_slipped(state)) values[comes_to_rest] = dir * velocity(state)[0];
  if (dir == 0 && is_on(state, 0))
    values[begins_to_slip] = law().sticking * normal_force(state) - std::abs(state.multiplier()[0]);
}

bool StickSlipFriction::leaves_branch(const LocalState& state) const {
  const double v = velocity(state)[0];
  // A sticking row that repeats another does not hold it.
  if (is_on(state, 0) && state.idle(0)) return std::abs(v) > no_velocity(state);
  return came_to_rest(state, v);
}

void StickSlipFriction::begin_branch(const LocalState& state, std::span<const int> crossed,
                                     Eigen::Ref<VectorX> memory) const {
  const auto has_crossed = [&](int k) { return std::find(crossed.begin(), crossed.end(), k) != crossed.end(); };
  const double v = velocity(state)[0];
  const auto slip_along = [&](double dir) {
    memory[0] = dir;
    memory[1] = 0;
    memory[2] = state.time();
  };
  if (std::isnan(memory[0]) || (is_on(state, 0) && state.idle(0))) {
    if (std::abs(v) > no_velocity(state)) {
      slip_along(std::copysign(1.0, v));
      memory[1] = 1;
    } else {
      memory[0] = 0;
    }
  } else if (has_crossed(begins_to_slip)) {
    slip_along(std::copysign(1.0, state.multiplier()[0]));
  } else if (has_crossed(comes_to_rest) || came_to_rest(state, v)) {
    memory[0] = 0;
  }
}

std::vector<OutputField> StickSlipFriction::output_fields() const {
  std::vector<OutputField> fields = JointFriction::output_fields();
  fields.push_back({"sticks", {}, "-", "how many of its surfaces stick", true});
  return fields;
}

void StickSlipFriction::write_output(const LocalState& state, double* values) const {
  JointFriction::write_output(state, values);
  values[joint().coordinates().size() + 1] = is_on(state, 0) ? 1 : 0;
}

}  // namespace bielle::mechanism
