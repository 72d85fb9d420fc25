// Contradictory or impossible contents of a mechanism file are refused, with file, line and key.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace {

std::string refusal(const std::string& nodes, const std::string& rest = "") {
  const std::string text = R"yaml(nodes:
)yaml" + nodes + R"yaml(
elements:
  body: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
)yaml" + rest;
  return message_of<bielle::InputError>([&] { read_mechanism_text(text, "model.yaml"); });
}

}  // namespace

TEST_CASE("holds that cannot be are refused where they stand") {
  CHECK_THAT(refusal("  a: {fixed: true, fixed_axes: own}"),
             Contains("model.yaml:2: nodes.a.fixed_axes") && Contains("a list of `fixed` directions"));
  CHECK_THAT(refusal("  a: {fixed: [rx], motion: {rz: \"t\"}}"), Contains("model.yaml:2: nodes.a.motion"));
}

TEST_CASE("a node is held by a number or formula of parameters that is not zero") {
  const auto held = [](const std::string& fixed) {
    const MechanismFile file =
        read_mechanism_text("parameters: {k: 2}\nnodes: {a: {fixed: " + fixed +
                                "}, b: {}}\nelements: {m: {type: point_mass, node: b, mass: 1}}\n",
                            "model.yaml");
    return file.model.nodes()[static_cast<std::size_t>(*file.model.find_node("a"))].freedom[0] == Freedom::fixed;
  };
  CHECK(held("true"));
  CHECK_FALSE(held("false"));
  CHECK(held("1"));
  CHECK_FALSE(held("0"));
  CHECK(held("k - 1"));
  CHECK_FALSE(held("k - 2"));
  CHECK_THAT(refusal("  a: {fixed: yes}"), Contains("model.yaml:2: nodes.a.fixed") && Contains("yes"));
}

TEST_CASE("the name of a part stands for its entries among those that are recorded") {
  const auto model = [](const std::string& only) {
    return read_mechanism_text(R"yaml(
nodes: {base: {}, arm_1: {}}
elements: {base: {type: point_mass, node: base, mass: 1}}
definitions:
  arm:
    nodes: {tip: {}, root: {}}
    elements: {tip: {type: point_mass, node: tip, mass: 1}}
    joints: {weld: {type: rigid, nodes: [tip, root]}}
parts: {arm_2: {part: arm}, arm_22: {part: arm}}
output: {only: )yaml" + only + "}\n",
                               "model.yaml");
  };
  const MechanismFile file = model("{nodes: [arm_2, base], joints: [arm_2.weld], elements: []}");
  const auto records = [&](Section section, const char* name) { return file.model.records({section, name}); };
  CHECK(records(Section::nodes, "arm_2.tip"));
  CHECK(records(Section::nodes, "arm_2.root"));
  CHECK(records(Section::nodes, "base"));
  CHECK_FALSE(records(Section::nodes, "arm_1"));
  CHECK_FALSE(records(Section::nodes, "arm_22.tip"));
  CHECK(records(Section::joints, "arm_2.weld"));
  CHECK_FALSE(records(Section::joints, "arm_22.weld"));
  CHECK_FALSE(records(Section::elements, "arm_2.tip"));
  const auto refused = [&](const std::string& only) { return message_of<bielle::InputError>([&] { model(only); }); };
  CHECK_THAT(refused("{nodes: [arm_2, arm_2.tip]}"), Contains("output.only.nodes[2]") && Contains("named twice"));
  CHECK_THAT(refused("{nodes: [arm_3]}"),
             Contains("'arm_3' is not one of the nodes, or a part") && Contains("did you mean"));
}

TEST_CASE("any number of nodes are placed relative to each other, but not in a circle") {
  const auto read = [](const std::string& nodes) {
    return read_mechanism_text(nodes + "elements: {m: {type: point_mass, node: n_1, mass: 1}}\n", "model.yaml");
  };
  const MechanismFile file = read(R"yaml(
nodes:
  "n_{k}": {repeat: {count: 50000, as: k}, at: "n_{k+1}", position: [1, 0, 0]}
  n_50001: {}
)yaml");
  CHECK(file.model.node(*file.model.find_node("n_1")).frame.x[0] == 50000);
  CHECK_THAT(message_of<bielle::InputError>([&] { read("nodes:\n  n_1: {at: b}\n  b: {at: c}\n  c: {at: b}\n"); }),
             Contains("model.yaml:4: nodes.c.at") && Contains("in a circle: n_1, b, c, b"));
}

TEST_CASE("bodies that carry each other in a circle are refused where they stand") {
  const std::string rest =
      "  first: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1], also: [c]}\n"
      "  second: {type: rigid_body, node: c, mass: 1, inertia: [1, 1, 1], also: [b]}\n";
  CHECK_THAT(refusal("  a: {}\n  b: {}\n  c: {}", rest),
             Contains("model.yaml:8: elements.second.also") && Contains("circle"));
}

TEST_CASE("a joint between nodes of one rigid part is told, since it holds nothing") {
  const auto warnings = [](const std::string& nodes) {
    return read_mechanism_text(
               "nodes: {crank: {}, pin: {position: [0.1, 0, 0]}, rod: {position: [0.1, 0, 0]}, wall: {fixed: true}}\n"
               "elements:\n"
               "  crank: {type: rigid_body, node: crank, mass: 1, inertia: [1, 1, 1], also: [pin]}\n"
               "  rod: {type: rigid_body, node: rod, mass: 1, inertia: [1, 1, 1]}\n"
               "joints:\n"
               "  knuckle: {type: hinge, nodes: [" +
                   nodes + "], axis: [0, 0, 1]}\n",
               "model.yaml")
        .warnings;
  };
  for (const std::string nodes : {"crank, pin", "pin, crank"}) {
    REQUIRE(warnings(nodes).size() == 1);
    CHECK_THAT(warnings(nodes)[0], Contains("model.yaml:6: joints.knuckle") && Contains("same rigid part"));
  }
  REQUIRE(warnings("ground, wall").size() == 1);
  CHECK_THAT(warnings("ground, wall")[0], Contains("are both held"));
  CHECK(warnings("pin, rod").empty());
  CHECK(warnings("ground, crank").empty());
}

TEST_CASE("velocities of what is held are refused, not forgotten") {
  CHECK_THAT(refusal("  a: {velocity: [0, 1, 0], fixed: [y]}"), Contains("nodes.a.velocity") && Contains("y"));
  CHECK_THAT(refusal("  a: {velocity: [0, 1, 0], fixed: true}"), Contains("nodes.a.velocity"));
  CHECK_THAT(refusal("  a: {velocity: [1, 0, 0], motion: {x: \"t\"}}"), Contains("nodes.a.velocity"));
  CHECK_THAT(refusal("  a: {angular_velocity: [0, 0, 1], fixed: [rx, ry, rz]}"), Contains("nodes.a.angular_velocity"));
  CHECK_THAT(refusal("  a: {angular_velocity: [0, 1, 0], fixed: [rx, ry]}"), Contains("nodes.a.angular_velocity"));
  CHECK_THAT(refusal("  a: {}\n  b: {velocity: [1, 0, 0]}",
                     "  two: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1], also: [b]}\n"),
             Contains("also") && Contains("velocity"));
  // Free directions have velocities; components may be zero.
  CHECK(refusal("  a: {velocity: [1, 0, 0], angular_velocity: [0, 0, 2], fixed: [y, z, rx, ry]}") ==
        "(nothing thrown)");
}

TEST_CASE("steps and times that mean nothing are refused where they stand") {
  const auto dynamic = [](const std::string& keys, const std::string& output = "") {
    return refusal("  a: {}", "analysis: [{type: dynamic, duration: 2, " + keys + "}]\n" + output);
  };
  CHECK_THAT(dynamic("step: 3"), Contains("analysis[1].step") && Contains("longer than the duration"));
  CHECK_THAT(dynamic("step: 1, tolerance: 2"), Contains("tolerance") && Contains("between 0 and 1"));
  CHECK_THAT(dynamic("step: 1, tolerance: 0"), Contains("tolerance"));
  CHECK_THAT(dynamic("step: 1, largest_step: 1"), Contains("largest_step") && Contains("`tolerance`"));
  CHECK_THAT(dynamic("step: 1, tolerance: 1e-4, largest_step: 0.1"), Contains("step") && Contains("largest step"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {times: [1, 0.5]}"), Contains("times[2]") && Contains("ascending"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {times: [2.5]}"), Contains("times[1]") && Contains("2 s"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {times: [1], every: 2}"), Contains("every") && Contains("not both"));
  CHECK(dynamic("tolerance: 1e-4", "output: {times: [0, 2]}") == "(nothing thrown)");
  CHECK(dynamic("tolerance: 1e-4", "output: {times: [500 ms, 1.5, 2 s]}") == "(nothing thrown)");
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {times: [1 m]}"),
             Contains("times[1]: expected a value in s, found one in 'm'"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {every: 0}"), Contains("every") && Contains("at least 1"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {checkpoint: 0}"), Contains("checkpoint") && Contains("at least 1"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {only: {node: [a]}}"), Contains("did you mean 'nodes'"));
  CHECK_THAT(dynamic("tolerance: 1e-4", "output: {load_factors: [1]}"),
             Contains("load_factors") && Contains("no static analysis"));
}
