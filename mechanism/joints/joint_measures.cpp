#include "mechanism/joints/joint_measures.hpp"

namespace bielle::mechanism {
namespace {

thread_local CoordinateDerivatives jet;
thread_local CoordinateSlopes slopes;

}  // namespace

double CoordinateMeasure::value(const LocalState& state) const {
  return joint().coordinate(coordinate_, state.of(0)).value;
}

double CoordinateMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  joint().calc_slopes(coordinate_, state.of(0), slopes);
  gradient.position().segment(state.slots().reference_row(0), slopes.g().size()) = slopes.g();
  return slopes.value;
}

double CoordinateRateMeasure::value(const LocalState& state) const {
  return joint().coordinate(coordinate_, state.of(0)).rate;
}

double CoordinateRateMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  const LocalState of_joint = state.of(0);
  joint().calc_coordinate(coordinate_, of_joint, jet);
  thread_local VectorX v;
  v.resize(of_joint.slots().size());
  get_local_velocities(of_joint, v);
  const int row = state.slots().reference_row(0);
  gradient.position().segment(row, v.size()) = jet.W().transpose() * v;  // d(w . v) = v . W dz
  gradient.rate().segment(row, v.size()) = jet.w();
  return jet.rate;
}

double ReactionMeasure::value(const LocalState& state) const { return joint().calc_reaction(state.of(0))[direction_]; }

double ReactionMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  thread_local MatrixX derivatives;
  const Vector6 reaction = joint().calc_reaction(state.of(0), derivatives);
  gradient.position().segment(state.slots().reference_row(0), derivatives.cols()) =
      derivatives.row(direction_).transpose();
  if (joint().reaction_has_rates()) {
    joint().calc_reaction_by_rates(state.of(0), derivatives);
    gradient.rate().segment(state.slots().reference_row(0), derivatives.cols()) =
        derivatives.row(direction_).transpose();
  }
  return reaction[direction_];
}

}  // namespace bielle::mechanism
