#include "mechanism/joints/cams/cam.hpp"

#include <fmt/format.h>

#include "mechanism/joints/lift_off.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

// -- flat follower

FlatFollower::FlatFollower(std::string name, JointFrames frames, Interpolation support, const Model& model)
    : MeasuredRows("cam", std::move(name), std::move(frames),
                   {{"angle", JointCoordinate::Kind::angle, JointCoordinate::by_type},
                    {"displacement", JointCoordinate::Kind::displacement, JointCoordinate::by_type}},
                   {{"push", "N"}}, model),
      support_(std::move(support)) {
  const Frame A = model.node(this->frames().first).frame * this->frames().on_first,
              B = model.node(this->frames().second).frame * this->frames().on_second;
  psi_drawn_ = std::atan2(A.R.col(1).dot(B.R.col(2)), A.R.col(0).dot(B.R.col(2)));
  s_drawn_ = B.R.col(0).dot(B.x - A.x) + support_.integral(psi_drawn_);
}

template <int order>
PairMeasureOf<order> FlatFollower::calc_turn(const LocalState& state) const {
  // The axes are x and y of J_A, rotated to the initial direction of the face.
  const Matrix3 axes = frames().on_first.R * Eigen::AngleAxisd(psi_drawn_, Vector3::UnitZ());
  const auto along = [&](int axis) {
    return measure_alignment<order>(state.node(0), state.node(1), axes.col(axis), frames().on_second.R.col(2));
  };
  return atan2(along(1), along(0));
}

template <int order>
PairMeasureOf<order> FlatFollower::calc_way_to_cam(int axis, const LocalState& state) const {
  const Frame &A = frames().on_first, &B = frames().on_second;
  return exchanged<order>(measure_position<order>(state.node(1), state.node(0), B.R.col(axis), B.x, A.x));
}

template <int order>
void FlatFollower::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  const auto turned = calc_turn<order>(state);
  const Interpolation::Values H = support_(psi_drawn_ + turned.value);
  rows[0] = compose(turned, H.value, H.slope, H.curvature) + calc_way_to_cam<order>(2, state);
}

PairMeasure FlatFollower::calc_own_coordinate(std::size_t index, const LocalState& state) const {
  const PairMeasure turned = calc_turn<2>(state);
  if (index == turn) return turned;
  const double psi = psi_drawn_ + coordinate(turn, state).value;
  const Interpolation::Values H = support_(psi);
  return compose(turned, support_.integral(psi) - s_drawn_, H.value, H.slope) - calc_way_to_cam<2>(0, state);
}

void FlatFollower::declare(Declaration& declaration) const {
  MeasuredPair::declare(declaration);
  declaration.event_functions = {lift_off()};
}

void FlatFollower::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = state.reaction()[0];
}

// -- lift

LiftedCoordinate::LiftedCoordinate(std::string name, const NamedCoordinate& angle, const NamedCoordinate& lifted,
                                   Interpolation lift)
    : Component("cam", std::move(name)),
      angle_(angle),
      lifted_(lifted),
      lift_(std::move(lift)),
      of_angle_(references_.add(*angle.joint)),
      of_lifted_(references_.add(*lifted.joint)) {}

/// Both coordinates at a state; valid until the next call in this thread.
struct LiftedCoordinate::Derivatives {
  CoordinateDerivatives angle, lifted;
};

void LiftedCoordinate::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  declaration.multipliers.push_back({"lift", lifted_.coordinate().force_units()});
  declaration.event_functions = {lift_off()};
}

// Phi = c_2 - f(c_1)
void LiftedCoordinate::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local CoordinateSlopes angle, lifted;
  angle_.joint->calc_slopes(angle_.index, state.of(of_angle_), angle);
  lifted_.joint->calc_slopes(lifted_.index, state.of(of_lifted_), lifted);
  const Interpolation::Values f = lift_(angle.value);
  const double lambda = state.multiplier()[0];
  r.segment(state.slots().reference_row(of_angle_), angle.g().size()) -= lambda * f.slope * angle.g();
  r.segment(state.slots().reference_row(of_lifted_), lifted.g().size()) += lambda * lifted.g();
  r[0] += lifted.value - f.value;
}

void LiftedCoordinate::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  thread_local Derivatives derivatives;
  angle_.joint->calc_coordinate(angle_.index, state.of(of_angle_), derivatives.angle);
  lifted_.joint->calc_coordinate(lifted_.index, state.of(of_lifted_), derivatives.lifted);
  const Interpolation::Values f = lift_(derivatives.angle.value);
  const double lambda = state.multiplier()[0];
  auto K = tangent.K.dense();
  const int of_angle = state.slots().reference_row(of_angle_), of_lifted = state.slots().reference_row(of_lifted_);
  const auto n = derivatives.angle.g().size(), m = derivatives.lifted.g().size();
  K.block(of_angle, of_angle, n, n) -=
      lambda *
      (f.slope * derivatives.angle.S() + f.curvature * derivatives.angle.g() * derivatives.angle.g().transpose());
  K.block(of_angle, 0, n, 1) -= f.slope * derivatives.angle.g();
  K.block(0, of_angle, 1, n) -= f.slope * derivatives.angle.g().transpose();
  K.block(of_lifted, of_lifted, m, m) += lambda * derivatives.lifted.S();
  K.block(of_lifted, 0, m, 1) += derivatives.lifted.g();
  K.block(0, of_lifted, 1, m) += derivatives.lifted.g().transpose();
}

void LiftedCoordinate::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                            Eigen::Ref<VectorX> acceleration) const {
  thread_local Derivatives derivatives;
  angle_.joint->calc_coordinate(angle_.index, state.of(of_angle_), derivatives.angle);
  lifted_.joint->calc_coordinate(lifted_.index, state.of(of_lifted_), derivatives.lifted);
  const Interpolation::Values f = lift_(derivatives.angle.value);
  const auto [turning, turning_rate] = Joint::calc_coordinate_rates(state.of(of_angle_), derivatives.angle);
  const auto [lifting, lifting_rate] = Joint::calc_coordinate_rates(state.of(of_lifted_), derivatives.lifted);
  velocity[0] += lifting - f.slope * turning;
  acceleration[0] += lifting_rate - f.slope * turning_rate - f.curvature * turning * turning;
}

void LiftedCoordinate::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = -state.reaction()[0];  // force along the coordinate
}

std::vector<OutputField> LiftedCoordinate::output_fields() const {
  return {{"force", {}, lifted_.coordinate().force_units(), "of the cam on the follower's coordinate"}};
}

void LiftedCoordinate::write_output(const LocalState& state, double* values) const { values[0] = -state.reaction()[0]; }

void LiftedCoordinate::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("'{}'.{} follows a lift over '{}'.{}, which repeats itself every {:.6g} rad",
                              lifted_.joint->name(), lifted_.coordinate().name, angle_.joint->name(),
                              angle_.coordinate().name, lift_.points().back() - lift_.points().front()));
}

}  // namespace bielle::mechanism
