// Residuals and tangents of beams, bodies, line loads, loads and joints, assembled by the system, do not allocate after
// their first evaluation.
#include <catch2/catch.hpp>

#include "tests/support/allocations.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::AllocationCount;
using bielle::test::ReadyModel;

namespace {

/// The model contains free, held, partly held, driven and carried nodes, curved, tapered and damped beams, loads by
/// formulas of place and time, a joint of each kind, drives.
const char* const model_text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  base:    {fixed: true}
  moved:   {position: [0, 0, 1], motion: {x: "0.1*sin(t)", rx: 0, ry: 0, rz: "t^2"}}
  guided:  {position: [1, 0, 0], fixed: [y, rx, ry]}
  a:       {position: [1, 1, 0], velocity: [0.1, 0.2, 0.3], angular_velocity: [1, 2, 3]}
  b:       {position: [2, 1, 0]}
  c:       {position: [2, 2, 1]}
  carried: {position: [2, 2, 2]}
  d:       {position: [3, 2, 2]}
  e:       {position: [3, 3, 3]}
elements:
  body:    {type: rigid_body, node: c, mass: 2, centre: [0.1, 0, 0], inertia: [1, 1, 1.5], also: [carried]}
  point:   {type: point_mass, node: d, mass: 1}
  block:   {type: rigid_body, node: e, mass: 1, inertia: [1, 1, 1]}
  slide:   {type: rigid_body, node: guided, mass: 1, inertia: [1, 1, 1]}
  shaft:
    type: beam
    nodes: [a, b]
    elements: 3
    damping: 0.01
    section: [{circle: 0.1, young: 1e6, poisson: 0.3, density: 1000}, {circle: 0.05, young: 1e6, poisson: 0.3, density: 1000}]
    distributed: {force: ["s*t", "cos(s)", "if(s < 0.5, 1, 2)"], moment: ["1 + s", "t", 0], follower: true, at: [0.1, 0]}
  bow:     {type: beam, nodes: [carried, d], elements: 2, arc_through: [2.5, 2.4, 2], section: {EA: 1e4, GAy: 1e4, GAz: 1e4, GJ: 100, EIy: 100, EIz: 100}, distributed: {force: [0, 0, "-s"]}}
  link:    {type: beam, nodes: [moved, a], elements: 2, section: {rectangle: [0.1, 0.2], young: 1e6, poisson: 0.3, density: 1000}}
  spring:  {type: spring_damper, nodes: [base, carried], stiffness: 100, damping: 1}
  strut:   {type: spring_damper, nodes: [b, d], force: "10*e + e^3 + v"}
joints:
  hinge:   {type: hinge, nodes: [base, b], axis: [0, 0, 1]}
  ball:    {type: spherical, nodes: [b, c]}
  rail:    {type: prismatic, nodes: [carried, e], axis: [1, 0, 0]}
  tube:    {type: cylindrical, nodes: [guided, e], axis: [0, 1, 0]}
  table:   {type: planar, nodes: [base, d], axis: [0, 0, 1]}
  weld:    {type: rigid, nodes: [c, e]}
drives:
  motor:   {joint: hinge, torque: "2*t"}
  push:    {joint: rail, speed: "0.1*t"}
  turn:    {joint: tube, coordinate: angle, angle: "0.2*t"}
loads:
  dead:    {node: a, force: ["t", 1, 2], moment: [0, "sin(t)", 0], at: [0.1, 0, 0]}
  thrust:  {node: carried, force: [1, "t", 0], follower: true}
)yaml";

}  // namespace

TEST_CASE("residual and tangent of a whole model allocate nothing after the first evaluation") {
  const ReadyModel model(model_text);
  State state = model.system.start(0.3);
  const VectorX dq = 0.01 * VectorX::Ones(model.system.dofs());
  VectorX r(model.system.size());
  std::vector<double> values;
  ResidualScale scale;
  TangentWeights step{1, 20, 1000, 20, 3}, rates{1, 20, 0, 0, 1}, acceleration{0, 0, 1, 1, 1};
  rates.velocity_level = true;
  acceleration.acceleration_level = true;
  const auto evaluate = [&] {
    model.system.residual(state, model.environment(), r, &scale);
    for (const TangentWeights* weights : {&step, &rates, &acceleration})
      model.system.tangent(state, model.environment(), *weights, &dq, values);
  };
  evaluate();
  const VectorX first = r;
  int calls = 0;
  {
    const AllocationCount count;
    evaluate();
    calls = count.calls();
  }
  CHECK(calls == 0);
  CHECK(first == r);
}

TEST_CASE("the counter sees a vector that is made") {
  const ReadyModel model(model_text);
  int calls = 0;
  {
    const AllocationCount count;
    const State state = model.system.start(0);
    calls = count.calls();
    CHECK(state.nodes.size() > 1);
  }
  CHECK(calls > 0);
}
