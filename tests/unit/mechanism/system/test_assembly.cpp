// The assembled tangent against finite differences of the assembled residual, with every kind of node: free, fixed in
// some directions, turning about one axis, carried rigidly, and prescribed.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/system/system.hpp"

using namespace bielle::mechanism;

namespace {

const char* const model_text = R"yaml(
gravity: [1, -2, -9.81]
nodes:
  a: {position: [0.1, 0.2, -0.3], rotation_vector: [0.3, -0.5, 0.2]}
  b: {position: [1.0, 0.4, 0.1], rotation_vector: [-0.2, 0.1, 0.9]}
  c: {position: [1.5, -0.2, 0.3], fixed: [y, rx, ry]}
  d: {position: [0.2, 0.9, 0.5], rotation_vector: [1, 0.2, 0]}
  e: {position: [2.0, 0.3, 0.6], rotation_vector: [0.2, 0.2, 0.3]}
  f: {position: [2.2, 0.1, 0.4], motion: {x: "0.1*sin(3*t)", rx: "0.2*t", ry: "t^2", rz: "0.3*sin(t)"}}
  g: {position: [0.4, 1.1, 0.2], rotation_vector: [0, 0.4, 1]}
  h: {position: [2.4, 0.3, 0.1], rotation_vector: [0.1, 0.4, 1]}
  i: {position: [1.7, 0.1, 0.2], rotation_vector: [0.5, 0.4, 1]}
elements:
  body_a: {type: rigid_body, node: a, mass: 2, centre: [0.1, 0.2, 0.05], inertia: [0.3, 0.4, 0.5], also: [d]}
  body_b: {type: rigid_body, node: b, mass: 1, centre: [0.1, -0.1, 0.2], inertia: [0.1, 0.12, 0.15], also: [e]}
  body_c: {type: rigid_body, node: c, mass: 3, centre: [0.1, -0.1, 0.2], inertia: [0.1, 0.12, 0.15], also: [i]}
  body_d: {type: rigid_body, node: d, mass: 0.7, centre: [-0.1, 0.1, 0.2], inertia: [0.1, 0.12, 0.15], also: [g]}
  body_f: {type: rigid_body, node: f, mass: 0.4, centre: [0.2, 0.1, 0.1], inertia: [0.1, 0.12, 0.15], also: [h]}
  body_g: {type: rigid_body, node: g, mass: 0.3, centre: [0.2, 0.1, 0.1], inertia: [0.1, 0.12, 0.15]}
  body_h: {type: rigid_body, node: h, mass: 0.6, centre: [0.2, 0.1, 0.1], inertia: [0.1, 0.12, 0.15]}
  body_i: {type: rigid_body, node: i, mass: 0.5, centre: [0.2, 0.1, 0.1], inertia: [0.1, 0.12, 0.15]}
  spring_gh: {type: spring_damper, nodes: [g, h], stiffness: 20, damping: 1, at: [[0.1, 0, 0.2], [0, 0.2, 0.1]]}
  spring_gi: {type: spring_damper, nodes: [i, g], stiffness: 10, damping: 3, at: [[0.1, 0, 0.2], [0, 0.2, 0.1]]}
  spring: {type: spring_damper, nodes: [d, e], stiffness: 30, damping: 2, at: [[0.1, 0, 0], [0, 0.2, 0]]}
joints:
  pivot: {type: hinge, nodes: [d, e], axis: [0.2, 0.3, 1], position: [0.5, 0.5, 0.5]}
  slide: {type: prismatic, nodes: [b, c], axis: [1, 0.3, 0.4]}
  tip: {type: spherical, nodes: [e, f]}
drives:
  motor: {joint: pivot, angle: "0.4*sin(2*t)"}
  push: {joint: slide, force: "3*t"}
)yaml";

/// Nodes that are free or fixed in all directions alone: joints and bodies write straight into the whole tangent.
const char* const free_text = R"yaml(
gravity: [1, -2, -9.81]
nodes:
  a: {position: [0.1, 0.2, -0.3], rotation_vector: [0.3, -0.5, 0.2]}
  b: {position: [1.0, 0.4, 0.1], rotation_vector: [-0.2, 0.1, 0.9]}
  c: {position: [1.5, -0.2, 0.3], rotation_vector: [0.4, 0, 0.2]}
  d: {position: [0.2, 0.9, 0.5], rotation_vector: [1, 0.2, 0], fixed: true}
elements:
  body_a: {type: rigid_body, node: a, mass: 2, centre: [0.1, 0.2, 0.05], inertia: [0.3, 0.4, 0.5]}
  body_b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.12, 0.15]}
  body_c: {type: rigid_body, node: c, mass: 3, centre: [0.1, -0.1, 0.2], inertia: [0.1, 0.12, 0.15]}
  spring: {type: spring_damper, nodes: [a, c], stiffness: 30, damping: 2, at: [[0.1, 0, 0], [0, 0.2, 0]]}
joints:
  pivot: {type: hinge, nodes: [a, b], axis: [0.2, 0.3, 1], position: [0.5, 0.5, 0.5]}
  ball: {type: spherical, nodes: [b, c], position: [1.2, 0.1, 0.3]}
  slide: {type: prismatic, nodes: [c, a], axis: [1, 0.3, 0.4]}
  sleeve: {type: cylindrical, nodes: [b, a], axis: [1, 0.2, 0.4]}
  table: {type: planar, nodes: [c, b], axis: [0.1, 0.3, 0.4]}
  foot: {type: rigid, nodes: [d, a]}
  wall: {type: hinge, nodes: [c, ground], axis: [0.2, 0.3, 1]}
)yaml";

/// Returns a state away from the reference, with rates and multipliers of order one. Fixed seed.
State random_state(const System& system, State& base, VectorX& dq, VectorX& v, VectorX& a) {
  std::srand(7);
  base = system.start(0.7);
  dq = 0.6 * VectorX::Random(system.dofs());
  v = VectorX::Random(system.dofs());
  a = VectorX::Random(system.dofs());
  base.multiplier = VectorX::Random(system.multipliers());
  State state = base;
  system.displace(state, base, dq);
  system.set_rates(state, v, a);
  return state;
}

MatrixX tangent_of(const System& system, const State& state, const Environment& environment,
                   const TangentWeights& weights, const VectorX* dq) {
  std::vector<double> values;
  system.tangent(state, environment, weights, dq, values);
  MatrixX J = MatrixX::Zero(system.size(), system.size());
  for (int column = 0; column < system.size(); ++column)
    for (int k = system.pattern().column_start()[static_cast<std::size_t>(column)];
         k < system.pattern().column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      J(system.pattern().row()[static_cast<std::size_t>(k)], column) = values[static_cast<std::size_t>(k)];
  return J;
}

void check_tangent(const System& system, const Environment& environment) {
  State base;
  VectorX dq, v, a;
  const State state = random_state(system, base, dq, v, a);
  const int n = system.size();
  // Weights of a time step: a change of dq changes v and a as well.
  const double rate = 3.0, acceleration = 7.0;
  const MatrixX J = tangent_of(system, state, environment, {1, rate, acceleration, 0, 1}, &dq);
  const auto residual = [&](int column, double e) {
    VectorX dq_e = dq, v_e = v, a_e = a;
    State moved = base;
    if (column < system.dofs()) {
      dq_e[column] += e;
      v_e[column] += rate * e;
      a_e[column] += acceleration * e;
    } else {
      moved.multiplier[column - system.dofs()] += e;
    }
    system.displace(moved, base, dq_e);
    system.set_rates(moved, v_e, a_e);
    VectorX r(n);
    system.residual(moved, environment, r);
    return r;
  };
  MatrixX difference(n, n);
  // Fourth-order differences: truncation e^4 and rounding 1e-16/e meet near e = 1e-3, at 1e-12.
  const double e = 1e-3;
  for (int column = 0; column < n; ++column)
    difference.col(column) =
        (8 * (residual(column, e) - residual(column, -e)) - (residual(column, 2 * e) - residual(column, -2 * e))) /
        (12 * e);
  const double scale = J.cwiseAbs().maxCoeff();
  Eigen::Index row, column;
  const double worst = (J - difference).cwiseAbs().maxCoeff(&row, &column);
  INFO("worst at " << system.equation_name(static_cast<int>(row)) << " by "
                   << system.unknown_name(static_cast<int>(column)));
  CHECK(worst < 1e-10 * scale);
}

}  // namespace

TEST_CASE("the assembled tangent is the derivative of the assembled residual for every kind of node") {
  for (const char* const text : {model_text, free_text})
    for (const bool carried_axes : {true, false}) {
      const MechanismFile file = read_mechanism_text(text, "assembly.yaml");
      System system(file.model);
      if (!carried_axes) system.set_aside({});
      check_tangent(system, file.model.environment);
    }
}

TEST_CASE("the assembled tangent is linear in its weights") {
  for (const char* const text : {model_text, free_text}) {
    const MechanismFile file = read_mechanism_text(text, "assembly.yaml");
    const System system(file.model);
    State base;
    VectorX dq, v, a;
    const State state = random_state(system, base, dq, v, a);
    const auto tangent = [&](double stiffness, double damping, double mass, double constraint) {
      return tangent_of(system, state, file.model.environment, {stiffness, damping, mass, 0, constraint}, &dq);
    };
    const MatrixX sum =
        0.3 * tangent(1, 0, 0, 0) + 3 * tangent(0, 1, 0, 0) + 7 * tangent(0, 0, 1, 0) + 0.6 * tangent(0, 0, 0, 1);
    CHECK((tangent(0.3, 3, 7, 0.6) - sum).cwiseAbs().maxCoeff() < 1e-13 * sum.cwiseAbs().maxCoeff());
  }
}

namespace {

/// Writes forces, and refuses the state then.
class Refusing final : public Component {
 public:
  explicit Refusing(const bool& refuses) : Component("refusing", "refusing"), refuses_(refuses) {}
  void declare(Declaration& declaration) const override { declaration.nodes = {1}; }
  void add_residual(const LocalState&, Eigen::Ref<VectorX> r) const override {
    if (!refuses_) return;
    r.setConstant(1e3);
    throw bielle::ComputationError("no such state");
  }

 private:
  const bool& refuses_;
};

}  // namespace

TEST_CASE("a component that refuses a state leaves nothing in the next residual") {
  MechanismFile file = read_mechanism_text(free_text, "assembly.yaml");
  bool refuses = false;
  file.model.add(std::make_unique<Refusing>(refuses), Entry{Section::elements, "refusing"});
  const System system(file.model);
  State base;
  VectorX dq, v, a, before(system.size()), after(system.size());
  const State state = random_state(system, base, dq, v, a);
  system.residual(state, file.model.environment, before);
  refuses = true;
  CHECK_THROWS_AS(system.residual(state, file.model.environment, after), bielle::ComputationError);
  refuses = false;
  system.residual(state, file.model.environment, after);
  CHECK(after == before);
}

TEST_CASE("rates of all nodes are the time derivatives of their positions, carried and prescribed ones too") {
  const MechanismFile file = read_mechanism_text(model_text, "assembly.yaml");
  const System system(file.model);
  State base;
  VectorX dq, v, a;
  const State state = random_state(system, base, dq, v, a);
  const double e = 1e-4;
  State ahead = state, behind = state;
  // q(t +- e) along constant independent accelerations: exp(+-e v + e^2/2 a) is right to third order for the
  // difference.
  ahead.time += e;
  behind.time -= e;
  system.displace(ahead, state, e * v + 0.5 * e * e * a);
  system.displace(behind, state, -e * v + 0.5 * e * e * a);
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const NodeState &node = state.nodes[i], &plus = ahead.nodes[i], &minus = behind.nodes[i];
    INFO("node " << file.model.node(static_cast<int>(i)).name);
    CHECK((node.v - (plus.x - minus.x) / (2 * e)).norm() < 1e-6);
    CHECK((node.a - (plus.x - 2 * node.x + minus.x) / (e * e)).norm() < 1e-6);
    const Vector3 turned = log_so3(Matrix3(minus.R.transpose() * plus.R));
    CHECK((node.Omega - turned / (2 * e)).norm() < 1e-6);
  }
}

TEST_CASE("unknowns and equations are named as the user knows them") {
  const MechanismFile file = read_mechanism_text(model_text, "assembly.yaml");
  const System system(file.model);
  CHECK(system.equation_name(0) == "force x at node 'a'");
  CHECK(system.unknown_name(4) == "rotation y of node 'a'");
  CHECK(system.equation_name(system.dofs()) == "constraint x of joint 'pivot'");
}
