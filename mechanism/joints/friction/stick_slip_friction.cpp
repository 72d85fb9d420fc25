#include "mechanism/joints/friction/stick_slip_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/joints/rest_limits.hpp"

namespace bielle::mechanism {
namespace {

enum StickSlipEvent { comes_to_rest, begins_to_slip };

/// The memory: direction of slip, 0 if it sticks, NaN if no motion has begun; whether it has slipped through an
/// accepted step; time at which it began to slip; number of consecutive rejections of its sticking at this instant;
/// values of the coordinates at which it stuck.
enum StickSlipMemory { slip_direction, has_slipped, slips_since, refusals, stuck_at };

}  // namespace

void StickSlipFriction::declare(Declaration& declaration) const {
  JointFriction::declare(declaration);
  const std::string& name = joint().coordinates()[surface().parts.back().coordinate].name;
  Declaration::Scalar row{"sticking " + name, "N"};
  row.switched = row.yields = true;
  declaration.multipliers.push_back(std::move(row));
  declaration.memory.assign(stuck_at + surface().parts.size(), 0.0);
  declaration.memory[slip_direction] = std::numeric_limits<double>::quiet_NaN();
  EventFunction rest{name + " sticks", EventFunction::Direction::falling},
      slip{name + " slips", EventFunction::Direction::falling};
  rest.begins_on = slip.begins_on = 1;  // a joint that cannot stick slips immediately
  slip.one_by_one = true;
  rest.nearest = slip.nearest = 1e-5;
  slip.reads_reaction = true;
  declaration.event_functions = {rest, slip};
}

double StickSlipFriction::direction(const LocalState& state) {
  const double kept = state.memory()[slip_direction];
  return std::isnan(kept) ? 0 : kept;
}

bool StickSlipFriction::sticks(const LocalState& state) { return state.memory()[slip_direction] == 0; }

bool StickSlipFriction::is_on(const LocalState& state, int /*row*/) const { return sticks(state); }

double StickSlipFriction::resisting_force(const LocalState& state, double lambda) const {
  return normal_force(state) * resistance(state, velocity(state)).rho[0] + lambda;
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

JointFriction::Vector StickSlipFriction::held(const LocalState::Segment& lambda) const {
  return Vector::Constant(1, lambda[0]);
}

double StickSlipFriction::distance(const LocalState& state) const {
  const LocalState of_joint = state.of(0);
  double away = 0;
  for (std::size_t k = 0; k < surface().parts.size(); ++k) {
    const FrictionSurface::Part& part = surface().parts[k];
    const double moved =
        joint().coordinate(part.coordinate, of_joint).value - state.memory()[static_cast<Eigen::Index>(stuck_at + k)];
    const bool turns = joint().coordinates()[part.coordinate].kind == JointCoordinate::Kind::angle;
    away += part.arm * (turns ? std::remainder(moved, 2 * M_PI) : moved);
  }
  return away;
}

void StickSlipFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  JointFriction::add_residual(state, r);
  r[0] += distance(state);
}

void StickSlipFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  JointFriction::add_tangent(state, tangent);
  if (!tangent.wants_K) return;
  const Slip& s = slip(state, false);
  const int at = row(state), n = static_cast<int>(s.w.rows());
  auto K = tangent.K.dense();
  K.block(at, 0, n, 1) += s.w;
  K.block(0, at, 1, n) += s.w.transpose();
}

void StickSlipFriction::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                             Eigen::Ref<VectorX> acceleration) const {
  velocity[0] += this->velocity(state)[0];
  acceleration[0] += this->acceleration(state);
}

double StickSlipFriction::acceleration(const LocalState& state) const {
  const Slip& s = slip(state, true);
  const LocalState of_joint = state.of(0);
  VectorX v(s.w.rows()), a(s.w.rows());
  get_local_velocities(of_joint, v);
  get_local_accelerations(of_joint, a);
  return s.w.col(0).dot(a) + s.by_position.col(0).dot(v);
}

double StickSlipFriction::longest_arm() const {
  double arm = 0;
  for (const FrictionSurface::Part& part : surface().parts) arm = std::max(arm, std::abs(part.arm));
  return arm;
}

double StickSlipFriction::no_velocity(const LocalState& state) const {
  return velocity_at_rest(state.of(0), longest_arm());
}

double StickSlipFriction::no_acceleration(const LocalState& state) const {
  return acceleration_at_rest(state.of(0), longest_arm());
}

void StickSlipFriction::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (direction(state) != 0 && is_open(state)) {
    const double v = velocity(state)[0];
    memory[has_slipped] = std::abs(v) > no_velocity(state) ? 1 : 0;
    if (memory[has_slipped] != 0) memory[slip_direction] = std::copysign(1.0, v);
    return;
  }
  if (direction(state) * velocity(state)[0] > no_velocity(state)) memory[has_slipped] = 1;
}

void StickSlipFriction::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const double dir = direction(state);
  values.setOnes();
  if (dir != 0 && is_open(state)) return;
  if (dir != 0) {
    const auto memory = state.memory();
    const double v = dir * velocity(state)[0], rounding = no_velocity(state);
    if (memory[has_slipped] != 0) {
      values[comes_to_rest] = v - rounding;
    } else {
      // Just after slip has begun, the velocity is only a rounding error, or an error of the scheme. The acceleration
      // is therefore included.
      const double a = dir * acceleration(state) + no_acceleration(state);
      const bool just_now = state.time() <= memory[slips_since];
      // A joint that can neither stick nor slip continues for a step, because other constraints may hold it.
      constexpr double often = 2;
      values[comes_to_rest] = !just_now ? std::max(v + rounding, a) : memory[refusals] < often ? a : 1;
    }
  } else if (holds(state)) {
    values[begins_to_slip] = law().sticking * normal_force(state) - std::abs(state.reaction()[0]);
  } else if (is_on(state, 0) && std::abs(acceleration(state)) > no_acceleration(state)) {
    values[begins_to_slip] = -1;  // other constraints had stopped the joint, which now accelerates
  }
}

void StickSlipFriction::stick_here(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  memory[slip_direction] = 0;
  const LocalState of_joint = state.of(0);
  for (std::size_t k = 0; k < surface().parts.size(); ++k)
    memory[static_cast<Eigen::Index>(stuck_at + k)] = joint().coordinate(surface().parts[k].coordinate, of_joint).value;
}

void StickSlipFriction::slip_along(double direction, bool moving, const LocalState& state, Eigen::Ref<VectorX> memory) {
  memory[slip_direction] = direction;
  memory[has_slipped] = moving ? 1 : 0;
  memory[slips_since] = state.time();
  memory[refusals] = 0;
}

void StickSlipFriction::begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const {
  const double v = velocity(state)[0];
  if (!known)
    memory[slip_direction] = std::numeric_limits<double>::quiet_NaN();
  else if (std::abs(v) > no_velocity(state))
    slip_along(std::copysign(1.0, v), true, state, memory);
  else if (is_open(state))
    slip_along(1, false, state, memory);
  else
    stick_here(state, memory);
}

bool StickSlipFriction::leaves_branch(const LocalState& state) const {
  return is_on(state, 0) && !holds(state) && std::abs(velocity(state)[0]) > no_velocity(state);
}

void StickSlipFriction::begin_branch(const LocalState& state, std::span<const int> crossed,
                                     Eigen::Ref<VectorX> memory) const {
  const auto has_crossed = [&](int k) { return std::find(crossed.begin(), crossed.end(), k) != crossed.end(); };
  const double v = velocity(state)[0];
  if (std::isnan(state.memory()[slip_direction])) return;
  if (is_on(state, 0) && !holds(state)) {
    const bool again = state.time() <= state.memory()[slips_since];
    const double refused = again ? state.memory()[refusals] : 0;
    // The remaining velocity may be an error of the scheme for a rate that has just passed zero. The acceleration then
    // decides; if this was wrong before at the same time, the velocity decides.
    if (has_crossed(begins_to_slip) && !(again && std::abs(v) > no_velocity(state))) {
      slip_along(std::copysign(1.0, acceleration(state)), false, state, memory);
      memory[refusals] = refused + 1;
    } else if (std::abs(v) > no_velocity(state)) {
      slip_along(std::copysign(1.0, v), true, state, memory);
    } else {
      stick_here(state, memory);
    }
  } else if (has_crossed(begins_to_slip)) {
    slip_along(std::copysign(1.0, state.reaction()[0]), false, state, memory);
  } else if (has_crossed(comes_to_rest)) {
    stick_here(state, memory);
  }
}

std::vector<OutputField> StickSlipFriction::output_fields() const {
  std::vector<OutputField> fields = JointFriction::output_fields();
  fields.push_back(by_coordinate("sticks", "-", "1 along the coordinates of a surface that sticks, else 0"));
  return fields;
}

void StickSlipFriction::write_output(const LocalState& state, double* values) const {
  JointFriction::write_output(state, values);
  write_by_coordinate(Vector::Constant(1, is_on(state, 0) ? 1 : 0), values + 2 * joint().coordinates().size());
}

}  // namespace bielle::mechanism
