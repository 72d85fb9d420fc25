#include "mechanism/joints/actions/coordinate_action.hpp"

namespace bielle::mechanism {

CoordinateAction::CoordinateAction(std::string type, std::string name, const Joint& joint, std::size_t coordinate)
    : Component(std::move(type), std::move(name)), joint_(joint), coordinate_(coordinate) {
  references_.add(joint);
}

void CoordinateAction::declare_references(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
}

void CoordinateAction::add_reaction_norm(const LocalState& /*state*/, double arm, Eigen::Ref<MatrixX> H) const {
  H.diagonal().array() += coordinate().kind == JointCoordinate::Kind::displacement ? 1 : 1 / (arm * arm);
}

CoordinateDerivatives& CoordinateAction::calc(const LocalState& state) const {
  thread_local CoordinateDerivatives jet;
  joint_.calc_coordinate(coordinate_, state.of(0), jet);
  return jet;
}

CoordinateSlopes& CoordinateAction::calc_slopes(const LocalState& state) const {
  thread_local CoordinateSlopes slopes;
  joint_.calc_slopes(coordinate_, state.of(0), slopes);
  return slopes;
}

const VectorX& CoordinateAction::rate_slope(const LocalState& state, CoordinateDerivatives& jet) {
  thread_local VectorX v, slope;
  const LocalState of_joint = state.of(0);
  v.resize(of_joint.slots().size());
  get_local_velocities(of_joint, v);
  slope.resize(v.size());
  slope.noalias() = jet.W().transpose() * v;
  return slope;
}

void CoordinateAction::add_kept(const LocalState& state, CoordinateSlopes& slopes, double distance,
                                Eigen::Ref<VectorX> r) {
  r.segment(row(state), slopes.g().size()) += state.multiplier()[0] * slopes.g();
  r[0] += distance;
}

void CoordinateAction::add_kept_tangent(const LocalState& state, CoordinateDerivatives& jet, LocalTangent& tangent) {
  const int at = row(state);
  const auto n = jet.g().size();
  auto K = tangent.K.dense();
  K.block(at, at, n, n) += state.multiplier()[0] * jet.S();
  K.block(at, 0, n, 1) += jet.g();
  K.block(0, at, 1, n) += jet.g().transpose();
}

std::pair<double, double> CoordinateAction::calc_kept_rates(const LocalState& state) const {
  return Joint::calc_coordinate_rates(state.of(0), calc(state));
}

void CoordinateAction::write_force(double force, double* values) const {
  for (std::size_t k = 0; k < joint_.coordinates().size(); ++k) values[k] = k == coordinate_ ? force : 0.0;
}

}  // namespace bielle::mechanism
