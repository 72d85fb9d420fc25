#include "mechanism/joints/cables/rope_friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Resistance to slip, relative to the stiffness of the rope: it tells pulleys apart that slip at once.
constexpr double hardening = 1e-9;

}  // namespace

RopeFriction::RopeFriction(const RopeSection& before, const RopeSection& after, RopeWrap wrap, double coefficient,
                           std::size_t number, std::size_t count)
    : Component(after.type(), after.name()),
      before_(before),
      after_(after),
      wrap_(std::move(wrap)),
      coefficient_(coefficient),
      number_(number),
      count_(count),
      stiffness_(after.material().EA * (1 / before.drawn_length() + 1 / after.drawn_length())),
      viscosity_(1e-10 * after.material().EA) {}

void RopeFriction::declare(Declaration& declaration) const {
  declaration.references = {&before_, &after_};
  declaration.stiffness = true;
  declaration.damping = after_.material().damping > 0;
  EventFunction slips{fmt::format("begins to slip on pulley '{}'", wrap_.pulley()), EventFunction::Direction::rising},
      sticks{fmt::format("sticks on pulley '{}'", wrap_.pulley()), EventFunction::Direction::falling};
  slips.restarts = sticks.restarts = false;
  declaration.event_functions = {slips, sticks};
}

const RopeFriction::Sides& RopeFriction::calc_sides(const LocalState& state) const {
  thread_local Sides sides;
  for (const int side : {0, 1}) section(side).calc_stretch(state.of(side), sides.stretch[side]);
  sides.wrap = std::max(0.0, wrap_.value(sides.stretch[0], sides.stretch[1]));
  sides.reduction = std::exp(-coefficient_ * sides.wrap);
  return sides;
}

// The pull of the tight side has no limit at zero: the equation then has a slope by the slip at each state.
double RopeFriction::excess(const Sides& sides, int towards) {
  return sides.reduction * sides.stretch[towards].pull - sides.stretch[1 - towards].tension;
}

/// Returns the force per increment of the slip that only makes it unique [N/m].
double RopeFriction::resistance(const LocalState& state) const {
  const LocalState slip = slip_of(state);
  const double rate = RopeSlip::has_begun(slip) ? RopeSlip::mean_rate(slip).by_slip : 0;
  return hardening * stiffness_ + viscosity_ * rate;
}

/// A rope that slips at a distant iterate is drawn to the tight side, or else sticks in the next one.
int RopeFriction::slips_towards(const LocalState& state, const Sides& sides) const {
  const LocalState slip = slip_of(state);
  if (!RopeSlip::may_change(slip)) return -1;
  const double increment = RopeSlip::increment(slip), held = (stiffness_ - resistance(state)) * increment;
  const int tight = sides.stretch[1].pull > sides.stretch[0].pull ? 1 : 0;
  return (tight == 1 ? held : -held) + excess(sides, tight) > 0 ? tight : -1;
}

void RopeFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Sides& sides = calc_sides(state);
  double& row = r[slip_row(state.slots())];
  const int towards = slips_towards(state, sides);
  const double increment = RopeSlip::increment(slip_of(state));
  if (towards < 0)
    row += stiffness_ * increment;
  else
    row += resistance(state) * increment + (towards == 1 ? -1 : 1) * excess(sides, towards);
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

void RopeFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !(tangent.wants_C && after_.material().damping > 0)) return;
  const Sides& sides = calc_sides(state);
  const int row = slip_row(state.slots()), towards = slips_towards(state, sides);
  if (towards < 0) {
    if (tangent.wants_K) tangent.K.dense()(row, row) += stiffness_;
    return;
  }
  thread_local MeasureGradient gradient;
  gradient.prepare(state.slots().size());
  const double sign = towards == 1 ? -1 : 1, tight = sides.stretch[towards].pull;
  add_pull(state, sides, towards, sign * sides.reduction, gradient);
  add_wrap(state, sides, -sign * coefficient_ * sides.reduction * tight, gradient);
  if (sides.stretch[1 - towards].taut) add_pull(state, sides, 1 - towards, -sign, gradient);
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.row(row) += gradient.position().transpose();
    K(row, row) += resistance(state);
  }
  if (tangent.wants_C) tangent.C.dense().row(row) += gradient.rate().transpose();
}

/// The slip occurs twice in the local layout, in those of both sections: its row is the one of the section before.
void RopeFriction::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  pattern.add_block(slip_row(slots), 0, 1, slots.size());
}

void RopeFriction::add_energy(const LocalState& state, Energy& energy) const {
  const Sides& sides = calc_sides(state);
  const double power = (sides.stretch[1].tension - sides.stretch[0].tension) * RopeSlip::rate(slip_of(state));
  energy.input += power;  // the power that the sections give away by the slip
  energy.dissipation += power;
}

/// Positive if the rope slips in the present step, or slipped in the last one at its end. At a slipping side the excess
/// is nearly zero; if it sticks there is no increment.
void RopeFriction::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const Sides& sides = calc_sides(state);
  const double slipped = std::abs(RopeSlip::last_increment(slip_of(state)));
  values.setConstant(stiffness_ * slipped + std::max(excess(sides, 0), excess(sides, 1)));
}

double RopeFriction::calc_slip(const LocalState& state, MeasureGradient& gradient) const {
  gradient.position()[slip_row(state.slots())] += 1;
  return RopeSlip::slip(slip_of(state));
}

double RopeFriction::calc_slip_rate(const LocalState& state, MeasureGradient& gradient) const {
  const RopeSlip::Rate rate = RopeSlip::mean_rate(slip_of(state));
  gradient.position()[slip_row(state.slots())] += rate.by_slip;
  return rate.value;
}

double RopeFriction::calc_friction(const LocalState& state, MeasureGradient& gradient) const {
  const Sides& sides = calc_sides(state);
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
