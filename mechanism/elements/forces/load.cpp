#include "mechanism/elements/forces/load.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/plausible.hpp"

namespace bielle::mechanism {

Load::Load(std::string name, int node, const Vector3& at, bool follower)
    : Component("load", std::move(name)), node_(node), c_(at), follower_(follower) {}

void Load::read(const YamlValue& components, bool moment, Model& model) {
  if (!components.is_sequence() || components.size() != 3)
    components.fail("expected three components, numbers or expressions of t");
  (moment ? has_moment_ : has_force_) = true;
  for (std::size_t k = 0; k < 3; ++k) {
    StateFormula& component = components_[(moment ? 3 : 0) + k];
    component = read_state_formula(components.at(k), {"t"}, model, references_);
    if (component.is_constant()) doubt_outside(components.at(k), components.at(k).number(), plausible_load);
  }
}

void Load::declare(Declaration& declaration) const {
  declaration.nodes = {node_};
  declaration.stiffness = true;
  references_.declare(declaration);
  for (const StateFormula& component : components_) {
    if (component.reads_state()) declaration.damping = true;
    if (component.reads_reactions()) declaration.reads_reactions = true;
  }
}

void Load::evaluate(const LocalState& state, Vector3& F, Vector3& m) const {
  const double t = state.time();
  for (std::size_t k = 0; k < 6; ++k)
    (k < 3 ? F : m)[static_cast<Eigen::Index>(k % 3)] =
        state.environment().load_factor * components_[k].value(state, {&t, 1});
}

void Load::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Matrix3& R = state.node(0).R;
  Vector3 F, m;
  evaluate(state, F, m);
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
    if (!components_[k].reads_state()) continue;
    thread_local FormulaGradient gradient;
    components_[k].calc(state, {&t, 1}, gradient);
    const Vector6 by_component = -state.environment().load_factor * direction(state, k);
    if (tangent.wants_K) tangent.K.dense().topRows<6>() += by_component * gradient.by_state.position().transpose();
    if (tangent.wants_C) tangent.C.dense().topRows<6>() += by_component * gradient.by_state.rate().transpose();
  }
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  const Matrix3& R = state.node(0).R;
  Vector3 F, m;
  evaluate(state, F, m);
  if (follower_)
    K.block<3, 3>(0, 3) += R * skew(F);
  else
    K.block<3, 3>(3, 3) -= skew(c_) * skew(R.transpose() * F) + skew(R.transpose() * m);
}

void Load::add_energy(const LocalState& state, Energy& energy) const {
  const NodeState& n = state.node(0);
  Vector3 F, m;
  evaluate(state, F, m);
  const Vector3 v_at = n.R.transpose() * n.v + n.Omega.cross(c_);
  energy.input += follower_ ? F.dot(v_at) + m.dot(n.Omega) : F.dot(n.R * v_at) + m.dot(n.R * n.Omega);
}

void Load::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& component : components_) component.add_break_points(0, times);
}

void Load::describe(const LocalState& /*state*/, Description& description) const {
  const auto vector = [&](std::size_t first) {
    return fmt::format("({}, {}, {})", components_[first].text(), components_[first + 1].text(),
                       components_[first + 2].text());
  };
  description.add("on node " + description.node(node_));
  if (has_force_) description.add(fmt::format("force {} N", vector(0)));
  if (has_force_ && !c_.isZero(0))
    description.add(fmt::format("at the point {} m in the node's axes", format_vector(c_)));
  if (has_moment_) description.add(fmt::format("moment {} N m", vector(3)));
  description.add(follower_ ? "turning with the node" : "fixed in space");
}

void read_load(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "node", "force", "moment", "at", "follower"}, "a load");
  const int node = node_named_by(entry.at("node"), model);
  const auto force = entry.find("force"), moment = entry.find("moment"), at = entry.find("at"),
             follower = entry.find("follower");
  if (!force && !moment) entry.fail("a load needs `force` or `moment`");
  if (at && !force) at->fail("`at` is the point where a `force` acts, and there is none");
  auto load = std::make_unique<Load>(name, node, at ? at->vector3() : Vector3::Zero(), follower && follower->boolean());
  model.when_read(Model::Stage::formulas, [load = load.get(), force, moment, &model] {
    if (force) load->read(*force, false, model);
    if (moment) load->read(*moment, true, model);
  });
  model.add(std::move(load), Entry{Section::loads, name}, Recorded::no);
}

}  // namespace bielle::mechanism
