#include "mechanism/elements/load.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace bielle::mechanism {

Load::Load(std::string name, int node, FormulaVector force, FormulaVector moment, const Vector3& at, bool follower)
    : Component("load", std::move(name)),
      node_(node),
      force_(std::move(force)),
      moment_(std::move(moment)),
      c_(at),
      follower_(follower) {}

void Load::declare(Declaration& declaration) const {
  declaration.nodes = {node_};
  declaration.stiffness = true;
}

void Load::evaluate(const LocalState& state, Vector3& F, Vector3& m) const {
  for (std::size_t k = 0; k < 3; ++k) {
    F[static_cast<Eigen::Index>(k)] = state.environment().load_factor * force_[k](state.time());
    m[static_cast<Eigen::Index>(k)] = state.environment().load_factor * moment_[k](state.time());
  }
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

// Column dTheta:  follower K = [ R F~ ; 0 ],   dead K = [ 0 ; -c~ (R^T F)~ - (R^T m)~ ]
void Load::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const Matrix3& R = state.node(0).R;
  Vector3 F, m;
  evaluate(state, F, m);
  if (follower_)
    tangent.K.block<3, 3>(0, 3) += R * skew(F);
  else
    tangent.K.block<3, 3>(3, 3) -= skew(c_) * skew(R.transpose() * F) + skew(R.transpose() * m);
}

void Load::add_energy(const LocalState& state, Energy& energy) const {
  const NodeState& n = state.node(0);
  Vector3 F, m;
  evaluate(state, F, m);
  const Vector3 v_at = n.R.transpose() * n.v + n.Omega.cross(c_);
  energy.input += follower_ ? F.dot(v_at) + m.dot(n.Omega) : F.dot(n.R * v_at) + m.dot(n.R * n.Omega);
}

void Load::add_break_points(std::vector<double>& times) const {
  for (const FormulaVector* vector : {&force_, &moment_}) mechanism::add_break_points(*vector, 0, times);
}

void read_load(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "node", "force", "moment", "at", "follower"}, "a load");
  const int node = model.node_named_by(entry.at("node"));
  const auto force = entry.find("force"), moment = entry.find("moment"), at = entry.find("at"),
             follower = entry.find("follower");
  if (!force && !moment) entry.fail("a load needs `force` or `moment`");
  if (at && !force) at->fail("`at` is the point where a `force` acts, and there is none");
  const auto formulas = [](const std::optional<YamlValue>& value) {
    return value ? read_formula_vector(*value, {"t"}, "three components, numbers or expressions of t")
                 : FormulaVector{};
  };
  model.add(std::make_unique<Load>(name, node, formulas(force), formulas(moment), at ? at->vector3() : Vector3::Zero(),
                                   follower && follower->boolean()),
            "");
}

}  // namespace bielle::mechanism
