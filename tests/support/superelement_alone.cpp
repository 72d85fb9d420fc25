#include "tests/support/superelement_alone.hpp"

#include <Eigen/Geometry>

namespace bielle::test {

using namespace mechanism;

SuperelementAlone::SuperelementAlone(const Superelement& superelement, std::vector<Matrix3> reference_rotations,
                                     std::vector<SuperelementPlacement::Load> loads, BodyFrame frame) {
  SuperelementPlacement placement;
  for (std::size_t k = 0; k < superelement.interfaces.size(); ++k) {
    placement.nodes.push_back(static_cast<int>(k));
    placement.reference_positions.push_back(superelement.interfaces[k].position);
    placement.reference_rotations.push_back(reference_rotations.empty() ? Matrix3(Matrix3::Identity())
                                                                        : reference_rotations[k]);
  }
  placement.loads = std::move(loads);
  placement.frame = frame;
  body_ = std::make_unique<SuperelementBody>("alone", superelement, std::move(placement));
  Declaration declaration;
  body_->declare(declaration);
  slots_.nodes = declaration.nodes;
  slots_.amplitudes = static_cast<int>(declaration.amplitudes.size());
}

State SuperelementAlone::rigid_state(const Frame& frame, const Vector3& v, const Vector3& Om) const {
  State state;
  for (const BodyPoint& point : body_->frame().points()) {
    NodeState node;
    node.x = frame.x + frame.R * point.X;
    node.R = frame.R * point.R_ref;
    node.v = v + frame.R * Om.cross(point.X);
    node.Omega = point.R_ref.transpose() * Om;
    node.a = frame.R * Om.cross(Om.cross(point.X));
    state.nodes.push_back(node);
  }
  state.amplitude = state.amplitude_rate = state.amplitude_acceleration = VectorX::Zero(slots_.amplitudes);
  return state;
}

State SuperelementAlone::random_state(Random& random, double deformation, double rate) const {
  const Frame frame{random.vector3(3), exp_so3(random.vector3(2))};
  const State state = moved(rigid_state(frame), random.vector(size(), deformation));
  return with_rates(state, random.vector(size(), rate), random.vector(size(), rate * rate));
}

State SuperelementAlone::moved(const State& state, const VectorX& z) const {
  State result = state;
  for (int k = 0; k < nodes(); ++k) {
    NodeState& node = result.nodes[static_cast<std::size_t>(k)];
    node.x += z.segment<3>(6 * k);
    node.R = node.R * exp_so3(z.segment<3>(6 * k + 3));
  }
  result.amplitude += z.tail(slots_.amplitudes);
  return result;
}

State SuperelementAlone::with_rates(const State& state, const VectorX& v, const VectorX& a) const {
  State result = state;
  for (int k = 0; k < nodes(); ++k) {
    NodeState& node = result.nodes[static_cast<std::size_t>(k)];
    node.v = v.segment<3>(6 * k);
    node.Omega = v.segment<3>(6 * k + 3);
    node.a = a.segment<3>(6 * k);
    node.Omegadot = a.segment<3>(6 * k + 3);
  }
  result.amplitude_rate = v.tail(slots_.amplitudes);
  result.amplitude_acceleration = a.tail(slots_.amplitudes);
  return result;
}

VectorX SuperelementAlone::velocity(const State& state) const {
  VectorX v(size());
  for (int k = 0; k < nodes(); ++k) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
    v.segment<6>(6 * k) << node.v, node.Omega;
  }
  v.tail(slots_.amplitudes) = state.amplitude_rate;
  return v;
}

VectorX SuperelementAlone::acceleration(const State& state) const {
  VectorX a(size());
  for (int k = 0; k < nodes(); ++k) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
    a.segment<6>(6 * k) << node.a, node.Omegadot;
  }
  a.tail(slots_.amplitudes) = state.amplitude_acceleration;
  return a;
}

VectorX SuperelementAlone::residual(const State& state) const {
  VectorX r = VectorX::Zero(size());
  body_->add_residual(local(state), r);
  return r;
}

SuperelementAlone::Tangent SuperelementAlone::tangent(const State& state) const {
  Tangent t;
  t.K = t.C = t.M = MatrixX::Zero(size(), size());
  LocalTangent parts{LocalMatrix(t.K), LocalMatrix(t.C), LocalMatrix(t.M)};
  body_->add_tangent(local(state), parts);
  return t;
}

Energy SuperelementAlone::energy(const State& state) const {
  Energy energy;
  body_->add_energy(local(state), energy);
  return energy;
}

VectorX SuperelementAlone::output(const State& state) const {
  Eigen::Index count = 0;
  for (const OutputField& field : body_->output_fields()) count += static_cast<Eigen::Index>(field.size());
  VectorX values(count);
  body_->write_output(local(state), values.data());
  return values;
}

CorotatedGeometry SuperelementAlone::geometry(const State& state) const {
  CorotatedGeometry geometry;
  body_->frame().solve(local(state), geometry);
  return geometry;
}

VectorX SuperelementAlone::coordinates(const State& state) const {
  LinearCoordinates coordinates;
  coordinates.solve(body_->matrices(), geometry(state).q);
  return coordinates.eps();
}

}  // namespace bielle::test
