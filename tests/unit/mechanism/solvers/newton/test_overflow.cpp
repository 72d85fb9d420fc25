// Overflow ends in a sentence, in statics and in dynamics, from the first iteration on.
#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::message_of;
using bielle::test::ReadyModel;
using Catch::Matchers::Contains;

namespace {

const char* const heavy = R"yaml(
gravity: [0, 0, -1e30]
nodes: {top: {position: [0, 0, 1], fixed: [x, y, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: top, mass: 1e308}
  s: {type: spring_damper, nodes: [ground, top], stiffness: 1}
)yaml";

}  // namespace

TEST_CASE("forces that overflow are named, in statics and in dynamics") {
  const ReadyModel model(heavy);
  State state = model.system.start(0);
  CHECK_THAT(message_of<ComputationError>(
                 [&] { solve_statics(model.system, model.environment(), 1, NewtonOptions{}, state, {}); }),
             Contains("force z at node 'top'") && Contains("overflow"));
  CHECK_THAT(message_of<ComputationError>([&] {
               TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                           model.system.start(0));
               integration.start(0.1);
               integration.step(0.1);
             }),
             Contains("node 'top'"));
}

TEST_CASE("a mechanism in which nothing holds the only free node is explained") {
  const ReadyModel model(R"yaml(
nodes: {loose: {position: [1, 0, 0]}}
elements: {m: {type: point_mass, node: ground, mass: 1}}
)yaml");
  CHECK_THAT(message_of<ComputationError>([&] {
               TimeIntegration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                               model.system.start(0));
             }),
             Contains("node 'loose'") && Contains("no mass"));
}
