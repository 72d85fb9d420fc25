#include "mechanism/joints/cables/rope_friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Resistance to slip, relative to the stiffness of the rope. It makes the slips of pulleys unique that slip at the
/// same time.
constexpr double hardening = 1e-9;

}  // namespace

RopeFriction::RopeFriction(const RopeSection& before, const RopeSection& after, RopeWrap wrap, double coefficient,
                           std::size_t number, std::size_t count, bool closed)
    : Component(after.type(), after.name()),
      before_(before),
      after_(after),
      wrap_(std::move(wrap)),
      coefficient_(coefficient),
      number_(number),
      count_(count),
      closed_(closed),
      stiffness_(after.material().EA * (1 / before.drawn_length() + 1 / after.drawn_length())),
      viscosity_(1e-10 * after.material().EA) {}

void RopeFriction::declare(Declaration& declaration) const {
  declaration.references = {&before_, &after_};
  declaration.stiffness = true;
  declaration.damping = damped();
  EventFunction slips{fmt::format("begins to slip on pulley '{}'", wrap_.pulley()), EventFunction::Direction::rising},
      sticks{fmt::format("sticks on pulley '{}'", wrap_.pulley()), EventFunction::Direction::falling};
  slips.restarts = sticks.restarts = false;
  declaration.event_functions = {slips, sticks};
}

const RopeFriction::Sides& RopeFriction::calc_sides(const LocalState& state, int order) const {
  thread_local Sides sides;
  for (const int side : {0, 1}) section(side).calc_stretch(state.of(side), sides.stretch[side], order);
  sides.wrap = std::max(0.0, wrap_.value(sides.stretch[0], sides.stretch[1]));
  sides.reduction = std::exp(-coefficient_ * sides.wrap);
  return sides;
}

// The pull of the tight side has no limit at zero, so that the equation has a slope by the slip at each state.
double RopeFriction::excess(const Sides& sides, int towards) {
  return sides.reduction * sides.stretch[towards].pull - sides.stretch[1 - towards].tension;
}

/// Returns an upper bound of the derivative of a pull by the change of the slip, nearly [N/m or N s/m].
double RopeFriction::stiffness(const LocalState& state, const Sides& sides, int side) const {
  const RopeMaterial& material = after_.material();
  const LocalState slip = slip_of(state);
  const double by_length = RopeSlip::rate_begins(slip) ? 0 : 1;
  return material.EA * (by_length + material.damping * RopeSlip::rate(slip).most) / sides.stretch[side].natural;
}

double RopeFriction::stiffness(const LocalState& state, const Sides& sides) const {
  return stiffness(state, sides, 0) + stiffness(state, sides, 1);
}

/// Returns the factor on the equation of a slipping rope. When the other side becomes taut, its tension grows with a
/// larger slope than that by which friction reduces the tight side's. Without the factor, a step of Newton's method
/// beyond this kink would increase the residual, and would be shortened, although the next step finds the solution.
double RopeFriction::scale(const Sides& sides, int towards) {
  return sides.stretch[1 - towards].taut ? 1 : 1 / sides.reduction;
}

/// Returns the force per change of the slip that only makes it unique [N/m or N s/m].
double RopeFriction::resistance(const LocalState& state) const {
  const LocalState slip = slip_of(state);
  if (RopeSlip::rate_begins(slip)) return hardening * after_.material().damping * stiffness_ + viscosity_;
  return hardening * stiffness_ + viscosity_ * RopeSlip::per_time(slip);
}

/// Returns the side towards which the rope slips, -1 if it sticks: its equation is the median of the three branches.
int RopeFriction::slips_towards(const LocalState& state, const Sides& sides) const {
  const LocalState slip = slip_of(state);
  if (!RopeSlip::may_change(slip) || slip.held(0)) return -1;
  const double change = RopeSlip::change(slip).value, held = -stiffness(state, sides) * change,
               resisted = resistance(state) * change;
  if (held < excess(sides, 1) - resisted) return 1;
  if (-held < excess(sides, 0) + resisted) return 0;
  return -1;
}

void RopeFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Sides& sides = calc_sides(state);
  const LocalState slip = slip_of(state);
  const auto [unknown, change] = RopeSlip::change(slip);
  const int towards = slips_towards(state, sides);
  double& row = r[slip_row(state.slots(), unknown)];
  if (towards < 0)
    row += stiffness(state, sides) * change;
  else
    row += scale(sides, towards) * (resistance(state) * change + (towards == 1 ? -1 : 1) * excess(sides, towards));
  if (!damped()) return;
  if (unknown == 1)
    r[slip_row(state.slots(), 0)] += stiffness_ * RopeSlip::increment(slip);
  else
    r[slip_row(state.slots(), 1)] += rate_factor() * (RopeSlip::rate_unknown(slip) - RopeSlip::rate(slip).value);
}

/// Adds the derivatives of a section's pull. @param factor  factor on them
void RopeFriction::add_pull(const LocalState& state, const Sides& sides, int side, double factor,
                            MeasureGradient& gradient) const {
  thread_local MeasureGradient pull;
  section(side).calc_pull_gradient(state.of(side), sides.stretch[side], pull);
  const int row = state.slots().reference_row(side), size = state.of(side).slots().size();
  gradient.position().segment(row, size) += factor * pull.position();
  gradient.rate().segment(row, size) += factor * pull.rate();
}

void RopeFriction::add_wrap(const LocalState& state, const Sides& sides, double factor,
                            MeasureGradient& gradient) const {
  if (sides.wrap == 0) return;
  const VectorX &arrives = sides.stretch[0].end_gradients[RopeSection::last_end],
                &leaves = sides.stretch[1].end_gradients[RopeSection::first_end];
  auto position = gradient.position();
  position.segment(state.slots().reference_row(0), arrives.size()) -= factor * wrap_.sense() * arrives;
  position.segment(state.slots().reference_row(1), leaves.size()) += factor * wrap_.sense() * leaves;
}

/// Adds the derivatives of the equation of a rope that sticks.
void RopeFriction::add_held(const LocalState& state, const Sides& sides, LocalTangent& tangent) const {
  thread_local VectorX gradient;
  gradient.setZero(state.slots().size());
  const double change = RopeSlip::change(slip_of(state)).value;
  const int row = change_row(state);
  for (const int side : {0, 1}) {
    const Slots& slots = state.of(side).slots();
    const double k = stiffness(state, sides, side);
    section(side).add_natural_gradient(state.of(side), sides.stretch[side], -k * change / sides.stretch[side].natural,
                                       gradient.segment(state.slots().reference_row(side), slots.size()));
  }
  gradient[row] += stiffness(state, sides);
  tangent.K.dense().row(row) += gradient.transpose();
}

/// Adds the derivatives of the equation of the unknown that does not follow from the balance of tensions.
void RopeFriction::add_other_tangent(const LocalState& state, LocalTangent& tangent) const {
  auto K = tangent.K.dense();
  const int slip = slip_row(state.slots(), 0), rate = slip_row(state.slots(), 1);
  if (change_row(state) == rate) {
    K(slip, slip) += stiffness_;
    return;
  }
  K(rate, rate) += rate_factor();
  K(rate, slip) -= rate_factor() * RopeSlip::rate(slip_of(state)).by_change;
}

void RopeFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !(tangent.wants_C && damped())) return;
  const Sides& sides = calc_sides(state, 2);
  if (tangent.wants_K && damped()) add_other_tangent(state, tangent);
  const int row = change_row(state), towards = slips_towards(state, sides);
  if (towards < 0) {
    if (tangent.wants_K) add_held(state, sides, tangent);
    return;
  }
  thread_local MeasureGradient gradient;
  gradient.prepare(state.slots().size());
  const double factor = scale(sides, towards), sign = towards == 1 ? -factor : factor,
               tight = sides.stretch[towards].pull;
  add_pull(state, sides, towards, sign * sides.reduction, gradient);
  add_wrap(state, sides, -sign * coefficient_ * sides.reduction * tight, gradient);
  if (sides.stretch[1 - towards].taut) add_pull(state, sides, 1 - towards, -sign, gradient);
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.row(row) += gradient.position().transpose();
    K(row, row) += factor * resistance(state);
  }
  if (tangent.wants_C) tangent.C.dense().row(row) += gradient.rate().transpose();
}

void RopeFriction::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  pattern.add_block(slip_row(slots, 0), 0, damped() ? 2 : 1, slots.size());
}

/// Returns the flow of unloaded rope whose strain the friction changes [m/s].
double RopeFriction::strain_flow(const Sides& sides, double slip_rate) const {
  if (closed_) return 0;
  const double turning =
      0.5 * (sides.stretch[0].ends[RopeSection::last_end].rate + sides.stretch[1].ends[RopeSection::first_end].rate);
  const double flow = slip_rate - wrap_.radius() * turning;
  return std::clamp(flow, std::min(0.0, slip_rate), std::max(0.0, slip_rate));
}

void RopeFriction::add_energy(const LocalState& state, Energy& energy) const {
  const Sides& sides = calc_sides(state);
  const RopeSection::Stretch &before = sides.stretch[0], &after = sides.stretch[1];
  const double rate = RopeSlip::rate(slip_of(state)).value;
  const double power =
      (after.tension - before.tension) * rate + (after.strain_energy - before.strain_energy) * strain_flow(sides, rate);
  energy.input += power;  // the power that the sections lose by the slip
  energy.dissipation += power;
}

/// Positive if the rope slips in the present step, or slipped at the end of the last one. The excess is nearly zero at
/// a slipping side; a sticking rope has no increment of slip.
void RopeFriction::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const Sides& sides = calc_sides(state);
  const double slipped = std::abs(RopeSlip::last_change(slip_of(state)));
  values.setConstant(stiffness_ * slipped + std::max(excess(sides, 0), excess(sides, 1)));
}

double RopeFriction::calc_slip(const LocalState& state, MeasureGradient& gradient) const {
  gradient.position()[slip_row(state.slots(), 0)] += 1;
  return RopeSlip::slip(slip_of(state));
}

double RopeFriction::calc_slip_rate(const LocalState& state, MeasureGradient& gradient) const {
  const RopeSlip::Value rate = RopeSlip::rate(slip_of(state));
  gradient.position()[change_row(state)] += rate.by_change;
  return rate.value;
}

double RopeFriction::calc_friction(const LocalState& state, MeasureGradient& gradient) const {
  const Sides& sides = calc_sides(state, 2);
  for (const int side : {0, 1})
    if (sides.stretch[side].taut) add_pull(state, sides, side, side == 1 ? 1 : -1, gradient);
  return sides.stretch[1].tension - sides.stretch[0].tension;
}

double RopeFriction::calc_wrap(const LocalState& state, MeasureGradient& gradient) const {
  const Sides& sides = calc_sides(state);
  add_wrap(state, sides, 1, gradient);
  return sides.wrap;
}

}  // namespace bielle::mechanism
