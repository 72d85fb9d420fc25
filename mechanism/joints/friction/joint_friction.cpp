#include "mechanism/joints/friction/joint_friction.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {

/// The two parts of the reaction whose magnitudes contribute to the normal force: forces (and the force on a thread),
/// moments.
struct Press {
  Eigen::Vector4d force;
  Vector3 moment;
};

Press press_of(const Vector6& reaction, double thread_radius) {
  Press press{{reaction[0], reaction[1], reaction[2], 0}, reaction.tail<3>()};
  if (thread_radius > 0) {
    press.force[3] = reaction[5] / thread_radius;
    press.moment[2] = 0;
  }
  return press;
}

}  // namespace

void JointFriction::declare(Declaration& declaration) const {
  declaration.references = {&joint_};
  declaration.stiffness = declaration.damping = true;
  declaration.reads_reactions = declaration.kinks = true;  // N has a kink if the reaction is zero
}

JointFriction::Vector JointFriction::velocity(const LocalState& state) const {
  const LocalState of_joint = state.of(0);
  Vector v = Vector::Zero(size());
  for (const FrictionSurface::Part& part : surface_.parts)
    v[part.component] += part.arm * joint_.coordinate(part.coordinate, of_joint).rate;
  return v;
}

JointFriction::Slip& JointFriction::slip(const LocalState& state, bool with_positions) const {
  thread_local Slip slip;
  thread_local VectorX velocities;
  const LocalState of_joint = state.of(0);
  const int n = of_joint.slots().size();
  slip.v.setZero(size());
  slip.w.setZero(n, size());
  if (with_positions) {
    slip.by_position.setZero(n, size());
    velocities.resize(n);
    get_local_velocities(of_joint, velocities);
  }
  for (std::size_t k = 0; k < surface_.parts.size(); ++k) {
    const auto& [coordinate, component, arm] = surface_.parts[k];
    CoordinateDerivatives& jet = slip.jets[k];
    if (with_positions)
      joint_.calc_coordinate(coordinate, of_joint, jet);
    else
      joint_.calc_slopes(coordinate, of_joint, jet);
    slip.v[component] += arm * jet.rate;
    slip.w.col(component) += arm * jet.w();
    if (with_positions) slip.by_position.col(component).noalias() += arm * (jet.W().transpose() * velocities);
  }
  return slip;
}

double JointFriction::normal_force(const LocalState& state) const {
  const Press press = press_of(joint_.calc_press(state.of(0)), surface_.thread_radius);
  return press.force.norm() + press.moment.norm() / surface_.moment_arm + surface_.preload;
}

double JointFriction::calc_normal_force(const LocalState& state, MeasureGradient& gradient) const {
  thread_local MatrixX derivatives;
  const Vector6 reaction = joint_.calc_press(state.of(0), derivatives);
  const Press press = press_of(reaction, surface_.thread_radius);
  const double force = press.force.norm(), moment = press.moment.norm();
  Vector6 by_reaction = Vector6::Zero();
  if (force > 0) {
    by_reaction.head<3>() = press.force.head<3>() / force;
    if (surface_.thread_radius > 0) by_reaction[5] = press.force[3] / (force * surface_.thread_radius);
  }
  if (moment > 0) by_reaction.tail<3>() += press.moment / (moment * surface_.moment_arm);
  gradient.position().segment(row(state), derivatives.cols()).noalias() = derivatives.transpose() * by_reaction;
  return force + moment / surface_.moment_arm + surface_.preload;
}

void JointFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Slip& s = slip(state, false);
  const Vector R = normal_force(state) * resistance(state, s.v).rho + held(state.multiplier());
  r.segment(row(state), s.w.rows()).noalias() += s.w * R;
}

void JointFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Slip& s = slip(state, true);
  const Resistance resist = resistance(state, s.v);
  const int at = row(state), n = static_cast<int>(s.w.rows()), z = state.slots().first_order_row();
  Nested<MeasureGradient> by_state;
  by_state->prepare(state.slots().size());
  const double N = calc_normal_force(state, *by_state);
  const Vector R = N * resist.rho + held(state.multiplier());
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    auto block = K.block(at, at, n, n);
    for (std::size_t k = 0; k < surface_.parts.size(); ++k)
      block += surface_.parts[k].arm * R[surface_.parts[k].component] * s.jets[k].W();
    block.noalias() += s.w * (N * resist.by_v) * s.by_position.transpose();
    K.middleRows(at, n).noalias() += (s.w * resist.rho) * by_state->position().transpose();
    if (resist.by_z.size() > 0) K.block(at, z, n, size()).noalias() += s.w * (N * resist.by_z);
  }
  if (tangent.wants_C) {
    auto C = tangent.C.dense();
    C.block(at, at, n, n).noalias() += s.w * (N * resist.by_v) * s.w.transpose();
    C.middleRows(at, n).noalias() += (s.w * resist.rho) * by_state->rate().transpose();
  }
}

double JointFriction::loss(const LocalState& /*state*/, const Vector& v, const Resistance& resistance) const {
  return resistance.rho.dot(v);
}

void JointFriction::add_energy(const LocalState& state, Energy& energy) const {
  const Vector v = velocity(state);
  const Resistance resist = resistance(state, v);
  const double N = normal_force(state), lost = N * loss(state, v, resist);
  energy.dissipation += lost;
  energy.input += lost - N * resist.rho.dot(v);  // power that is neither dissipated nor stored
}

OutputField JointFriction::by_coordinate(const std::string& name, const std::string& units,
                                         const std::string& description) const {
  return {name, {joint_.coordinates().size()}, units, description, true};
}

void JointFriction::write_by_coordinate(const Vector& by_component, double* values) const {
  std::fill_n(values, joint_.coordinates().size(), 0.0);
  for (const FrictionSurface::Part& part : surface_.parts) values[part.coordinate] = by_component[part.component];
}

std::vector<OutputField> JointFriction::output_fields() const {
  return {joint_.force_field("friction", "force or torque of friction along the joint's coordinates"),
          by_coordinate("normal_force", "N", "which presses the surface that slides along each coordinate")};
}

void JointFriction::write_output(const LocalState& state, double* values) const {
  const Vector v = velocity(state);
  const double N = normal_force(state);
  const Vector R = N * resistance(state, v).rho + held(state.reaction());
  const std::size_t count = joint_.coordinates().size();
  std::fill_n(values, count, 0.0);
  for (const FrictionSurface::Part& part : surface_.parts) values[part.coordinate] -= part.arm * R[part.component];
  write_by_coordinate(Vector::Constant(size(), N), values + count);
}

void JointFriction::describe(const LocalState& /*state*/, Description& description) const {
  std::string text = law_.describe() + ", on";
  for (const FrictionSurface::Part& part : surface_.parts) {
    const JointCoordinate& coordinate = joint_.coordinates()[part.coordinate];
    text += fmt::format(" {}", coordinate.name);
    if (coordinate.kind != JointCoordinate::Kind::displacement && surface_.thread_radius == 0)
      text += fmt::format(" (at {:.6g} m)", std::abs(part.arm));
  }
  if (surface_.thread_radius > 0) text += fmt::format(" along the thread at {:.6g} m", surface_.thread_radius);
  text += ", pressed by the reaction's force";
  if (std::isfinite(surface_.moment_arm)) text += fmt::format(", its moment over {:.6g} m", surface_.moment_arm);
  if (surface_.preload > 0) text += fmt::format(", {:.6g} N of preload", surface_.preload);
  description.add_line(text);
}

}  // namespace bielle::mechanism
