#include "mechanism/io/settle_idle_rotations.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/idle_rotations.hpp"

namespace bielle::mechanism {
namespace {

/// Types whose forces on a node act from the beginning. A contact or a brake, in contrast, may act only later.
const std::set<std::string> steady_types = {"point_mass", "rigid_body", "spring_damper", "distance",
                                            "spherical",  "cable",      "load"};

/// Returns whether a node can be given inertia for its rotations. Nodes with an angular velocity at the start are left
/// out, because this rate would be lost.
bool turns_freely(const Node& node) {
  return !node.carrier && node.angular_velocity.isZero(0) &&
         std::all_of(node.freedom.begin() + 3, node.freedom.end(),
                     [](Freedom freedom) { return freedom == Freedom::free; });
}

bool has_a_line(const RigidBody& body) {
  constexpr double slender = 1e-12;
  const Matrix3 J = body.properties().inertia;
  return J.isZero() || J.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() <= slender * J.trace();
}

/// Returns bodies without inertia about some axis, by their nodes. Nodes with parts of other types are left out.
std::map<int, RigidBody*> slender_bodies(const Model& model) {
  std::map<int, RigidBody*> bodies;
  for (const Member& member : model.members())
    if (auto* body = dynamic_cast<RigidBody*>(member.component.get());
        body != nullptr && turns_freely(model.node(body->node())) && has_a_line(*body))
      bodies.emplace(body->node(), body);
  if (bodies.empty()) return bodies;
  for (const Node& node : model.nodes())
    if (node.carrier) bodies.erase(*node.carrier);
  for (const Member& member : model.members()) {
    Declaration declaration;
    member.component->declare(declaration);
    if (declaration.passive || steady_types.contains(member.component->type())) continue;
    for (const int node : declaration.nodes) bodies.erase(node);
  }
  return bodies;
}

}  // namespace

void settle_idle_rotations(Model& model) {
  const std::map<int, RigidBody*> bodies = slender_bodies(model);
  if (bodies.empty()) return;
  std::vector<int> nodes;
  for (const auto& [node, body] : bodies) nodes.push_back(node);
  const System system(model);
  const double length = model_length(system.start(0));
  for (const IdleRotations& idle : idle_rotations(system, model.environment, nodes)) {
    Node& node = model.node(idle.node);
    if (idle.all) {
      std::fill(node.freedom.begin() + 3, node.freedom.end(), Freedom::fixed);
      node.angular_velocity.setZero();
      continue;
    }
    // The motion does not depend on this inertia: no moment acts about these axes, and a rod has equal moments of
    // inertia about all axes normal to its line.
    RigidBody& body = *bodies.at(idle.node);
    const MassProperties& properties = body.properties();
    const double own = properties.inertia_about_origin().trace();
    const double inertia = 1e-4 * (own > 0 ? own : properties.mass * length * length);
    for (const Vector3& axis : idle.axes) body.add_idle_inertia(inertia * axis * axis.transpose());
  }
}

}  // namespace bielle::mechanism
