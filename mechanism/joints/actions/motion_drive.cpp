#include "mechanism/joints/actions/motion_drive.hpp"

#include <cmath>

namespace bielle::mechanism {

void MotionDrive::add_kinks(std::vector<double>& times) const {
  const std::vector<double> points = f_.break_points();
  times.insert(times.end(), points.begin(), points.end());
}

void MotionDrive::declare_row(Declaration& declaration, const std::string& row, ConstraintKind kind) const {
  declare_drive(declaration);
  Declaration::Scalar multiplier{row, coordinate().force_units(), 0, kind};
  multiplier.switched = can_release();
  declaration.multipliers.push_back(std::move(multiplier));
}

std::vector<TimeDependent::Formula> MotionDrive::time_formulas() const {
  if (f_.is_constant()) return {};
  const LawText text = law_text();
  return {{text.driven, text.units, part(), coordinate().kind != JointCoordinate::Kind::displacement}};
}

void MotionDrive::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  values[0] = released(state) ? 0 : f_(state.time());
}

// -- position

double PositionDrive::distance(const LocalState& state, double principal) const {
  const double target = state.motion_factor() * law()(state.time());
  // An angle is prescribed modulo turns: the drive counts turns by time, not by memory, so that the result does not
  // depend on step sizes or restarts. Whole turns are subtracted from the target separately: otherwise rounding of
  // large angles would prevent Newton's method from reaching its tolerance.
  if (coordinate().kind == JointCoordinate::Kind::angle)
    return std::remainder(principal - std::remainder(target, 2 * M_PI), 2 * M_PI);
  return principal - target;
}

void PositionDrive::declare(Declaration& declaration) const {
  declare_row(declaration, coordinate().name, ConstraintKind::holonomic);
}

void PositionDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  add_kept(state, slopes, distance(state, slopes.principal), r);
}

void PositionDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) add_kept_tangent(state, calc(state), tangent);
}

void PositionDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  const auto [first, second] = calc_kept_rates(state);
  velocity[0] += first - law().derivative(state.time(), 1);
  acceleration[0] += second - law().derivative(state.time(), 2);
}

void PositionDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law().derivative(state.time(), 1);
}

// -- rate

void RateDrive::declare(Declaration& declaration) const {
  declare_row(declaration, coordinate().name + " rate", ConstraintKind::nonholonomic);
  declaration.damping = true;
}

void RateDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  r.segment(row(state), slopes.w().size()) += state.multiplier()[0] * slopes.w();
  r[0] += slopes.rate - law()(state.time());
}

void RateDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  CoordinateDerivatives& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.block(at, at, n, n) += state.multiplier()[0] * jet.W();
    K.block(at, 0, n, 1) += jet.w();
    K.block(0, at, 1, n) += rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(0, at, 1, n) += jet.w().transpose();
}

void RateDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                     Eigen::Ref<VectorX> acceleration) const {
  CoordinateDerivatives& jet = calc(state);
  const LocalState of_joint = state.of(0);
  VectorX v(of_joint.slots().size()), a(v.size());
  get_local_velocities(of_joint, v);
  get_local_accelerations(of_joint, a);
  velocity[0] += jet.rate - law()(state.time());
  acceleration[0] += jet.w().dot(a) + v.dot(jet.W() * v) - law().derivative(state.time(), 1);
}

void RateDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law()(state.time());
}

}  // namespace bielle::mechanism
