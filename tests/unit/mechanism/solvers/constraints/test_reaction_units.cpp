// Forces and torques in the norm of reactions of components that do not define it by themselves.
#include <catch2/catch.hpp>

#include "mechanism/elements/forces/held_directions.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

TEST_CASE("a held rotation shares a moment with two rods as the smallest norm has it") {
  // M + 2 a F = T, min 2 F^2 + M^2/L^2: M = T L^2/(L^2 + 2 a^2), where the arm L of the rods is a.
  const double a = 3, T = 30;
  const ReadyModel model(R"yaml(
nodes: {body: {fixed: [rz]}}
elements: {body: {type: rigid_body, node: body, mass: 1, inertia: [1, 1, 1]}}
joints:
  right: {type: distance, nodes: [ground, body], at: [[3, 1, 0], [3, 0, 0]]}
  left: {type: distance, nodes: [ground, body], at: [[-3, 1, 0], [-3, 0, 0]]}
loads: {turn: {node: body, moment: [0, 0, 30]}}
)yaml");
  State state =
      TimeIntegration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0)).state();
  CHECK(redundancy_arm(model.system, model.environment(), state) == Approx(a));
  ReactionNorm(model.system).balance(model.environment(), state);
  const HeldDirections* held = nullptr;
  for (const Member& member : model.file.model.members())
    if (const auto* found = dynamic_cast<const HeldDirections*>(member.component.get())) held = found;
  REQUIRE(held);
  CHECK(state.reaction[model.system.slots_of(*held).multiplier_begin] == Approx(T / 3).epsilon(1e-8));
}
