#include "mechanism/elements/rigid_body/rigid_body.hpp"

#include <utility>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

RigidBody::RigidBody(std::string type, std::string name, int node, const MassProperties& properties,
                     const std::string& node_name)
    : Component(std::move(type), std::move(name)),
      properties_(properties),
      node_(node),
      m_(properties.mass),
      c_(properties.centre),
      J_(properties.inertia_about_origin()) {
  const Vector3& c = properties.centre;
  const Matrix3& J = properties.inertia;
  attributes_ = {{"node", node_name},
                 {"mass", fmt::format("{}", m_)},
                 {"centre", fmt::format("{} {} {}", c.x(), c.y(), c.z())},
                 {"inertia", fmt::format("{} {} {} {} {} {}", J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2))}};
}

void RigidBody::declare(Declaration& declaration) const {
  declaration.nodes = {node_};
  declaration.stiffness = declaration.damping = declaration.mass = declaration.in_blocks = true;
}

void RigidBody::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const NodeState& n = state.node(0);
  const Vector3 a = n.a - state.environment().gravity;
  const Vector3 convected = n.Omegadot.cross(c_) + n.Omega.cross(n.Omega.cross(c_));
  r.segment<3>(0) += m_ * (a + n.R * convected);
  r.segment<3>(3) += J_ * n.Omegadot + n.Omega.cross(J_ * n.Omega) + m_ * c_.cross(n.R.transpose() * a);
}

// clang-format off
// Columns dx | dTheta of node axes:
//   M = [ m I        -m R c~ ]   C = [ 0  -m R (Omega~ c~ + (Omega~ c)~) ]   K = [ 0  -m R (Omegadot~ c + Omega~ Omega~ c)~ ]
//       [ m c~ R^T    J      ]       [ 0  Omega~ J - (J Omega)~          ]       [ 0  m c~ (R^T (xddot - g))~             ]
// clang-format on
void RigidBody::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const NodeState& n = state.node(0);
  const bool centred = c_.isZero(0);  // no coupling of translation and rotation
  if (tangent.wants_M) {
    tangent.M.add_identity(0, 0, m_);
    tangent.M.add(3, 3, J_);
  }
  if (tangent.wants_C) tangent.C.add(3, 3, skew(n.Omega) * J_ - skew(J_ * n.Omega));
  if (centred) return;
  const Matrix3 c = skew(c_);
  if (tangent.wants_M) {
    const Matrix3 coupling = m_ * n.R * c;
    tangent.M.add(0, 3, -coupling);
    tangent.M.add(3, 0, -coupling.transpose());
  }
  if (tangent.wants_C) tangent.C.add(0, 3, -m_ * n.R * (skew(n.Omega) * c + skew(n.Omega.cross(c_))));
  if (tangent.wants_K) {
    const Vector3 convected = n.Omegadot.cross(c_) + n.Omega.cross(n.Omega.cross(c_));
    tangent.K.add(0, 3, -m_ * n.R * skew(convected));
    tangent.K.add(3, 3, m_ * c * skew(n.R.transpose() * (n.a - state.environment().gravity)));
  }
}

void RigidBody::add_pattern(const Slots& /*slots*/, LocalPattern& pattern) const {
  pattern.add_diagonal(0, 0);
  pattern.add_block(3, 3);
  if (c_.isZero(0)) return;
  pattern.add_block(0, 3);
  pattern.add_block(3, 0);
}

void RigidBody::add_energy(const LocalState& state, Energy& energy) const {
  const NodeState& n = state.node(0);
  energy.kinetic +=
      0.5 * m_ * n.v.squaredNorm() + m_ * n.v.dot(n.R * n.Omega.cross(c_)) + 0.5 * n.Omega.dot(J_ * n.Omega);
  energy.gravity -= m_ * state.environment().gravity.dot(n.x + n.R * c_);
}

void RigidBody::describe(const LocalState& /*state*/, Description& description) const {
  const Matrix3& J = properties_.inertia;
  description.add(fmt::format("mass {:.6g} kg on node {}", m_, description.node(node_)));
  description.add(fmt::format("centre {} m", format_vector(c_)));
  if (!J.isZero(0))
    description.add(
        fmt::format("inertia about it xx {:.6g}, yy {:.6g}, zz {:.6g}, xy {:.6g}, xz {:.6g}, yz {:.6g} kg m^2", J(0, 0),
                    J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2)));
}

std::vector<OutputField> RigidBody::output_fields() const {
  return {{"centre", {3}, "m", "position of the centre of mass, inertial"},
          {"momentum", {3}, "N s", "linear momentum, inertial"},
          {"angular_momentum", {3}, "N m s", "angular momentum about the inertial origin, inertial"}};
}

void RigidBody::write_output(const LocalState& state, double* values) const {
  const NodeState& n = state.node(0);
  Eigen::Map<Eigen::Matrix<double, 9, 1>> out(values);
  const Vector3 momentum = m_ * (n.v + n.R * n.Omega.cross(c_));
  out << n.x + n.R * c_, momentum, n.x.cross(momentum) + n.R * (J_ * n.Omega + m_ * c_.cross(n.R.transpose() * n.v));
}

void RigidBody::draw(Drawing& drawing) const {
  if (drawing.shaped()) return;
  drawing.add({.shape = "body", .places = {{node_, {}}}, .values = {{"centre", numbers_of(properties_.centre)}}});
}

}  // namespace bielle::mechanism
