#include "mechanism/joints/coordinate_action.hpp"

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

CoordinateJet& CoordinateAction::calc(const LocalState& state) const {
  thread_local CoordinateJet jet;
  joint_.calc_coordinate(coordinate_, state.of(0), jet);
  return jet;
}

const VectorX& CoordinateAction::rate_slope(const LocalState& state, CoordinateJet& jet) {
  thread_local VectorX v, slope;
  const LocalState of_joint = state.of(0);
  v.resize(of_joint.slots().size());
  get_local_velocities(of_joint, v);
  slope.resize(v.size());
  slope.noalias() = jet.W().transpose() * v;
  return slope;
}

OutputField CoordinateAction::force_field(const std::string& name, const std::string& description) const {
  std::string units;
  for (const JointCoordinate& each : joint_.coordinates()) units += (units.empty() ? "" : ", ") + std::string(each.force_units());
  return {name, {joint_.coordinates().size()}, units, description, true};
}

void CoordinateAction::write_force(double force, double* values) const {
  for (std::size_t k = 0; k < joint_.coordinates().size(); ++k) values[k] = k == coordinate_ ? force : 0.0;
}

}  // namespace bielle::mechanism
