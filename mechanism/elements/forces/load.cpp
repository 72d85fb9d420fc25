#include "mechanism/elements/forces/load.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {

Load::Load(std::string name, int node, const Vector3& at, bool follower)
    : Component("load", std::move(name)), node_(node), c_(at), follower_(follower) {}

void Load::read(const YamlValue& components, bool moment, Model& model) {
  formulas_.read(components, moment, "expected three components, numbers or expressions of t", model, references_);
}

void Load::declare(Declaration& declaration) const {
  declaration.nodes = {node_};
  declaration.stiffness = true;
  references_.declare(declaration);
  formulas_.declare(declaration);
}

void Load::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Matrix3& R = state.node(0).R;
  Vector3 F, m;
  formulas_.evaluate(state, F, m);
  if (follower_) {
    r.segment<3>(0) -= R * F;
    r.segment<3>(3) -= c_.cross(F) + m;
  } else {
    r.segment<3>(0) -= F;
    r.segment<3>(3) -= c_.cross(R.transpose() * F) + R.transpose() * m;
  }
}

Vector6 Load::direction(const LocalState& state, std::size_t component) const {
  const Vector3 e = Vector3::Unit(static_cast<Eigen::Index>(component % 3));
  const Matrix3& R = state.node(0).R;
  const Vector3 in_node = follower_ ? e : Vector3(R.transpose() * e);
  Vector6 direction;
  if (component < 3)
    direction << (follower_ ? Vector3(R * e) : e), c_.cross(in_node);
  else
    direction << Vector3::Zero(), in_node;
  return direction;
}

// Column dTheta:  follower K = [ R F~ ; 0 ],   dead K = [ 0 ; -c~ (R^T F)~ - (R^T m)~ ]
void Load::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const double t = state.time();
  for (std::size_t k = 0; k < 6; ++k) {
    if (!formulas_.component(k).reads_state()) continue;
    thread_local FormulaGradient gradient;
    formulas_.component(k).calc(state, {&t, 1}, gradient);
    const Vector6 by_component = -state.environment().load_factor * direction(state, k);
    if (tangent.wants_K) tangent.K.dense().topRows<6>() += by_component * gradient.by_state.position().transpose();
    if (tangent.wants_C) tangent.C.dense().topRows<6>() += by_component * gradient.by_state.rate().transpose();
  }
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  const Matrix3& R = state.node(0).R;
  Vector3 F, m;
  formulas_.evaluate(state, F, m);
  if (follower_)
    K.block<3, 3>(0, 3) += R * skew(F);
  else
    K.block<3, 3>(3, 3) -= skew(c_) * skew(R.transpose() * F) + skew(R.transpose() * m);
}

void Load::add_energy(const LocalState& state, Energy& energy) const {
  const NodeState& n = state.node(0);
  Vector3 F, m;
  formulas_.evaluate(state, F, m);
  const Vector3 v_at = n.R.transpose() * n.v + n.Omega.cross(c_);
  energy.input += follower_ ? F.dot(v_at) + m.dot(n.Omega) : F.dot(n.R * v_at) + m.dot(n.R * n.Omega);
}

void Load::add_break_points(std::vector<double>& times) const { formulas_.add_break_points(times); }

void Load::describe(const LocalState& /*state*/, Description& description) const {
  description.add("on node " + description.node(node_));
  if (formulas_.has_force()) description.add(fmt::format("force {} N", formulas_.force_text()));
  if (formulas_.has_force() && !c_.isZero(0))
    description.add(fmt::format("at the point {} m in the node's axes", format_vector(c_)));
  if (formulas_.has_moment()) description.add(fmt::format("moment {} N m", formulas_.moment_text()));
  description.add(follower_ ? "turning with the node" : "fixed in space");
}

const KeyTable& load_keys() {
  using namespace keys;
  static const KeyTable table{
      "a load",
      "A force and a moment on a node.",
      {{"node", name_of("node"), required, "The loaded node."},
       {"force", list_of(3, state_formula("N", {"t"})).as_vector().in_inertial_axes(), optional,
        "Components of the force as formulas of the time t and measures."},
       {"moment", list_of(3, state_formula("N m", {"t"})).as_axial().in_inertial_axes(), optional,
        "Components of the moment as formulas of the time t and measures."},
       {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"),
        "Point of application of the force in the axes of the node."},
       {"follower", boolean(), otherwise("false"),
        "Whether the components are along the axes of the node and turn with it; otherwise they are inertial."}}};
  return table;
}

void read_load(const std::string& name, const YamlValue& entry, Model& model) {
  const int node = node_named_by(entry.at("node"), model);
  const auto force = entry.find("force"), moment = entry.find("moment"), at = entry.find("at");
  if (!force && !moment) entry.fail("a load needs `force` or `moment`");
  if (at && !force) at->fail("`at` is the point where a `force` acts, and there is none");
  auto load = std::make_unique<Load>(name, node, entry.at("at").vector3(), entry.at("follower").boolean());
  model.when_read(Model::Stage::formulas, [load = load.get(), force, moment, &model] {
    if (force) load->read(*force, false, model);
    if (moment) load->read(*moment, true, model);
  });
  model.add(std::move(load), Entry{Section::loads, name});
}

std::vector<OutputField> Load::output_fields() const {
  return {{"force", {3}, "N", "force at the point of application, inertial components"},
          {"moment", {3}, "N m", "moment in addition to that of the force, inertial components"}};
}

void Load::write_output(const LocalState& state, double* values) const {
  Vector3 F, m;
  formulas_.evaluate(state, F, m);
  const Matrix3 R = follower_ ? state.node(0).R : Matrix3(Matrix3::Identity());
  Eigen::Map<Vector6>(values) << R * F, R * m;
}

void Load::draw(Drawing& drawing) const {
  drawing.add({.shape = "force", .places = {{node_, {c_, Matrix3::Identity()}}}});
}

}  // namespace bielle::mechanism
