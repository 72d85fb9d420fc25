// Nodes carried rigidly, also by nodes that are carried themselves, held in part, or moved: they move as points of one
// body, and bodies on them are one body.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/system/system.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::derivative;
using bielle::test::error;
using bielle::test::Random;

namespace {

enum class Hold { free, partly, moved };

Node root_node(Hold hold) {
  Node node;
  node.name = std::string("a");
  node.frame = {Vector3(0.3, -0.2, 0.5), exp_so3({0.4, -0.7, 0.2})};
  if (hold == Hold::partly) node.freedom[1] = node.freedom[3] = node.freedom[4] = Freedom::fixed;
  if (hold == Hold::moved) {
    node.freedom.fill(Freedom::prescribed);
    node.freedom[2] = Freedom::free;
    const char* laws[] = {"0.3*sin(2*t)", "0.1*t^2", "0", "0.5*t", "sin(t)", "0.2*t^2"};
    for (std::size_t k = 0; k < 6; ++k) node.motion[k] = bielle::Expression(laws[k], {"t"});
    node.motion[2] = {};
  }
  return node;
}

struct Chain {
  Frame b{Vector3(1.1, 0.2, 0.1), exp_so3({0.1, 0.9, -0.3})}, c{Vector3(1.5, -0.4, 0.8), exp_so3({-0.5, 0.2, 1.3})};
  MassProperties body_a{2, {0.1, 0.2, -0.1}, Vector3(0.3, 0.4, 0.5).asDiagonal()};
  MassProperties body_b{0.7, {-0.1, 0.3, 0.2}, Vector3(0.2, 0.15, 0.1).asDiagonal()};
  MassProperties body_c{1.3, {0.2, 0.1, 0.4}, Vector3(0.1, 0.2, 0.25).asDiagonal()};
};

void add_body(Model& model, int node, const MassProperties& p) {
  model.add(std::make_unique<RigidBody>("rigid_body", model.node(node).name, node, p),
            Entry{Section::elements, model.node(node).name});
}

/// Three bodies: a carries b, b carries c. The carried nodes come first, so that the order of the file does not help.
void three_bodies(Model& model, Hold hold) {
  const Chain chain;
  Node b, c;
  b.name = std::string("b");
  c.name = std::string("c");
  b.frame = chain.b;
  c.frame = chain.c;
  c.carrier = 2;
  b.carrier = 3;
  model.add_node(c);
  model.add_node(b);
  model.add_node(root_node(hold));
  add_body(model, 1, chain.body_c);
  add_body(model, 2, chain.body_b);
  add_body(model, 3, chain.body_a);
  model.environment.gravity = Vector3(1, 2, -9.81);
}

/// The three bodies as one body.
void one_body(Model& model, Hold hold) {
  const Chain chain;
  const Node root = root_node(hold);
  const Frame back = inverse(root.frame);
  model.add_node(root);
  add_body(model, 1, chain.body_a + placed(back * chain.b, chain.body_b) + placed(back * chain.c, chain.body_c));
  model.environment.gravity = Vector3(1, 2, -9.81);
}

struct Evaluation {
  VectorX r;
  MatrixX J;
  Energy energy;
};

Evaluation evaluate(const Model& model) {
  const System system(model);
  Random random(3);
  const State base = system.start(0.4);
  State state = base;
  const VectorX dq = random.vector(system.dofs(), 0.8), v = random.vector(system.dofs()),
                a = random.vector(system.dofs());
  system.displace(state, base, dq);
  system.set_rates(state, v, a);
  Evaluation e;
  e.r.resize(system.size());
  system.residual(state, model.environment, e.r);
  std::vector<double> values;
  system.tangent(state, model.environment, {1, 3, 7, 0, 1}, &dq, values);
  e.J = MatrixX::Zero(system.size(), system.size());
  for (int column = 0; column < system.size(); ++column)
    for (int k = system.pattern().column_start()[static_cast<std::size_t>(column)];
         k < system.pattern().column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      e.J(system.pattern().row()[static_cast<std::size_t>(k)], column) = values[static_cast<std::size_t>(k)];
  e.energy = system.energy(state, model.environment);
  return e;
}

}  // namespace

TEST_CASE("bodies on carried nodes are one body, whatever holds the node that carries them") {
  for (const Hold hold : {Hold::free, Hold::partly, Hold::moved}) {
    CAPTURE(static_cast<int>(hold));
    Model three, one;
    three_bodies(three, hold);
    one_body(one, hold);
    const Evaluation many = evaluate(three), single = evaluate(one);
    REQUIRE(many.r.size() == single.r.size());
    REQUIRE(many.r.size() == (hold == Hold::free ? 6 : hold == Hold::partly ? 3 : 1));
    // Forces of order 30, tangents of order 100, a few dozen roundings.
    CHECK(error(many.r, single.r) < 1e-12);
    CHECK(error(many.J, single.J) < 1e-11);
    CHECK_THAT(many.energy.kinetic, Catch::WithinRel(single.energy.kinetic, 1e-13));
    CHECK_THAT(many.energy.gravity, Catch::WithinRel(single.energy.gravity, 1e-13));
    CHECK_THAT(many.energy.input, Catch::WithinAbs(single.energy.input, 1e-12));
  }
}

TEST_CASE("carried nodes of a moved node have the rates of their positions") {
  Model model;
  three_bodies(model, Hold::moved);
  const System system(model);
  const auto at = [&](double t) {
    State state = system.start(t);
    system.set_rates(state, VectorX::Zero(1), VectorX::Zero(1));
    return state;
  };
  const double t0 = 0.6;
  const State state = at(t0);
  for (const std::size_t node : {1, 2, 3}) {
    CAPTURE(node);
    const NodeState& n = state.nodes[node];
    const Vector3 v = derivative([&](double t) -> Vector3 { return at(t0 + t).nodes[node].x; });
    const Vector3 a = derivative([&](double t) -> Vector3 { return at(t0 + t).nodes[node].v; });
    const Matrix3 Rdot = derivative([&](double t) -> Matrix3 { return at(t0 + t).nodes[node].R; });
    const Vector3 Omegadot = derivative([&](double t) -> Vector3 { return at(t0 + t).nodes[node].Omega; });
    CHECK(error(n.v, v) < 1e-10);
    CHECK(error(n.a, a) < 1e-10);
    CHECK(error(n.R.transpose() * Rdot, skew(n.Omega)) < 1e-10);
    CHECK(error(n.Omegadot, Omegadot) < 1e-10);
  }
}

TEST_CASE("a node with one free rotation turns about the inertial axis that is left") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Model model;
    Node node = root_node(Hold::free);
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
      node.freedom[static_cast<std::size_t>(3 + other)] = Freedom::fixed;
    model.add_node(node);
    const System system(model);
    State state = system.start(0);
    VectorX dq = VectorX::Zero(system.dofs());
    dq[3] = 0.7;
    system.displace(state, system.start(0), dq);
    CHECK(error(state.nodes[1].R, exp_so3(0.7 * Vector3::Unit(axis)) * node.frame.R) < 1e-15);
  }
}

TEST_CASE("the power of what moves a node is the rate of the energy of the bodies on it") {
  Model model;
  three_bodies(model, Hold::moved);
  Node& root = model.node(3);
  root.freedom[2] = Freedom::prescribed;
  root.motion[2] = bielle::Expression("cos(t)", {"t"});
  const System system(model);
  REQUIRE(system.dofs() == 0);
  const auto energy = [&](double t) {
    State state = system.start(t);
    system.set_rates(state, VectorX(), VectorX());
    return system.energy(state, model.environment);
  };
  const double t0 = 0.6;
  const double rate = derivative([&](double t) {
    const Energy e = energy(t0 + t);
    return e.kinetic + e.gravity;
  });
  CHECK_THAT(energy(t0).input, Catch::WithinRel(rate, 1e-9));
}
