#include "mechanism/elements/forces/node_force.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {

NodeForce::NodeForce(std::string name, std::array<int, 2> nodes, const Vector3& at, Axes axes)
    : Component("node_force", std::move(name)), nodes_(nodes), c_(at), axes_(axes) {}

void NodeForce::read(const YamlValue& components, bool moment, Model& model) {
  formulas_.read(components, moment, "expected three components, numbers or formulas of t and the state", model,
                 references_);
}

void NodeForce::declare(Declaration& declaration) const {
  declaration.nodes.assign(nodes_.begin(), nodes_.end());
  declaration.stiffness = true;
  references_.declare(declaration);
  formulas_.declare(declaration);
}

Matrix3 NodeForce::axes(const LocalState& state) const {
  return axes_ == Axes::inertial ? Matrix3(Matrix3::Identity()) : state.node(axes_ == Axes::first ? 0 : 1).R;
}

NodeForce::Map12 NodeForce::of_force(const LocalState& state) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Vector3 arm = second.x + second.R * c_ - first.x;
  Map12 map;
  map << Matrix3::Identity(), first.R.transpose() * skew(arm), -Matrix3::Identity(), -skew(c_) * second.R.transpose();
  return map;
}

NodeForce::Map12 NodeForce::of_moment(const LocalState& state) {
  Map12 map;
  map << Matrix3::Zero(), state.node(0).R.transpose(), Matrix3::Zero(), -state.node(1).R.transpose();
  return map;
}

void NodeForce::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Vector3 f, mu;
  formulas_.evaluate(state, f, mu);
  const Matrix3 A = axes(state);
  r.head<12>() += of_force(state) * (A * f) + of_moment(state) * (A * mu);
}

// At fixed F and m:  d(R_1^T (a x F)) = (R_1^T (a x F))~ dTheta_1 - R_1^T F~ da,   da = dx_2 - dx_1 - R_2 c~ dTheta_2,
//   d(-c x R_2^T F) = -c~ (R_2^T F)~ dTheta_2,  d(R_k^T m) = (R_k^T m)~ dTheta_k;   and dF = A df - A f~ dTheta_A.
void NodeForce::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Matrix3 A = axes(state);
  const Map12 by_force = of_force(state) * A, by_moment = of_moment(state) * A;
  const double t = state.time();
  for (std::size_t k = 0; k < 6; ++k) {
    if (!formulas_.component(k).reads_state()) continue;
    thread_local FormulaGradient gradient;
    formulas_.component(k).calc(state, {&t, 1}, gradient);
    const Vector12 direction =
        state.environment().load_factor * (k < 3 ? by_force : by_moment).col(static_cast<Eigen::Index>(k % 3));
    if (tangent.wants_K) tangent.K.dense().topRows<12>() += direction * gradient.by_state.position().transpose();
    if (tangent.wants_C) tangent.C.dense().topRows<12>() += direction * gradient.by_state.rate().transpose();
  }
  if (!tangent.wants_K) return;
  Vector3 f, mu;
  formulas_.evaluate(state, f, mu);
  const Vector3 F = A * f, m = A * mu, arm = second.x + second.R * c_ - first.x;
  const Vector3 F_2 = second.R.transpose() * F;
  const Matrix3 by_arm = -first.R.transpose() * skew(F);
  auto K = tangent.K.dense();
  K.block<3, 3>(3, 3) += skew(first.R.transpose() * (arm.cross(F) + m));
  K.block<3, 3>(3, 0) -= by_arm;
  K.block<3, 3>(3, 6) += by_arm;
  K.block<3, 3>(3, 9) -= by_arm * second.R * skew(c_);
  K.block<3, 3>(9, 9) -= skew(c_) * skew(F_2) + skew(second.R.transpose() * m);
  if (axes_ == Axes::inertial) return;
  K.block<12, 3>(0, axes_ == Axes::first ? 3 : 9) -= by_force * skew(f) + by_moment * skew(mu);
}

void NodeForce::add_energy(const LocalState& state, Energy& energy) const {
  Vector3 f, mu;
  formulas_.evaluate(state, f, mu);
  const Matrix3 A = axes(state);
  energy.input -=
      (of_force(state) * (A * f) + of_moment(state) * (A * mu)).dot(pair_rate(state.node(0), state.node(1)));
}

void NodeForce::add_break_points(std::vector<double>& times) const { formulas_.add_break_points(times); }

std::vector<OutputField> NodeForce::output_fields() const {
  return {{"force", {3}, "N", "on the second node, inertial components"},
          {"moment", {3}, "N m", "on the second node, inertial components"}};
}

void NodeForce::write_output(const LocalState& state, double* values) const {
  Vector3 f, mu;
  formulas_.evaluate(state, f, mu);
  const Matrix3 A = axes(state);
  Eigen::Map<Vector6> result(values);
  result << A * f, A * mu;
}

void NodeForce::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("on node {}, back on {}", description.node(nodes_[1]), description.node(nodes_[0])));
  description.add(fmt::format("force {} N, moment {} N m", formulas_.force_text(), formulas_.moment_text()));
  if (!c_.isZero(0)) description.add(fmt::format("at the point {} m in the second node's axes", format_vector(c_)));
  description.add(axes_ == Axes::first    ? "along the first node's axes"
                  : axes_ == Axes::second ? "along the second node's axes"
                                          : "along inertial axes");
}

const KeyTable& node_force_keys() {
  using namespace keys;
  static const KeyTable table{
      "a node_force",
      "A force and a moment between two nodes.",
      {type_key(),
       {"nodes", list_of(2, name_of("node")), required,
        "The two nodes: force and moment act on the second, and back on the first at the same place."},
       {"force", list_of(3, state_formula("N", {"t"})).as_vector().in_inertial_axes(), optional,
        "Components of the force as formulas of the time t and measures."},
       {"moment", list_of(3, state_formula("N m", {"t"})).as_axial().in_inertial_axes(), optional,
        "Components of the moment as formulas of the time t and measures."},
       {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"), "Point of application in the axes of the second node."},
       {"axes", word({"first", "second", "inertial"}, "whose axes the components are along"), otherwise("first"),
        "Axes of the components: those of the first node, of the second node, or inertial ones."}}};
  return table;
}

void read_node_force(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  if (nodes[0] == nodes[1]) entry.at("nodes").fail("a node_force acts between two different nodes");
  const auto force = entry.find("force"), moment = entry.find("moment");
  if (!force && !moment) entry.fail("a node_force needs `force` or `moment`");
  const std::string along = entry.at("axes").word();
  auto made = std::make_unique<NodeForce>(name, std::array<int, 2>{nodes[0], nodes[1]}, entry.at("at").vector3(),
                                          along == "first"    ? NodeForce::Axes::first
                                          : along == "second" ? NodeForce::Axes::second
                                                              : NodeForce::Axes::inertial);
  model.when_read(Model::Stage::formulas, [added = made.get(), force, moment, &model] {
    if (force) added->read(*force, false, model);
    if (moment) added->read(*moment, true, model);
  });
  model.add(std::move(made), Entry{Section::elements, name});
}

void NodeForce::draw(Drawing& drawing) const {
  drawing.add({.shape = "force", .places = {{nodes_[1], {c_, Matrix3::Identity()}}}});
}

}  // namespace bielle::mechanism
