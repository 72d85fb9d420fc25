// Loops that cannot close: the open joint, its gap, and the joint that contradicts it.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/rough_drawing.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace test_unclosed {
namespace {

/// Returns links of 0.3, `coupler` and 0.7 m between posts `ground` m apart, drawn roughly.
std::string four_bar(double coupler, double ground, const std::string& crank_keys = "",
                     const std::string& rocker_keys = "") {
  bielle::test::RoughDrawing drawing(3, 0.05, 0.3);
  drawing.add_body("crank", Vector3(0.1, 0.1, 0), exp_so3(Vector3(0, 0, 0.8)));
  drawing.add_body("coupler", Vector3(0.6, 0.4, 0), exp_so3(Vector3(0, 0, 0.2)));
  drawing.add_body("rocker", Vector3(1, 0.3, 0), exp_so3(Vector3(0, 0, 1.7)));
  const auto hinge = [](const std::string& name, const std::string& nodes, const std::string& at,
                        const std::string& keys) {
    return fmt::format(
        "  {}: {{type: hinge, nodes: [{}], at: [{}], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, "
        "0]]{}}}\n",
        name, nodes, at, keys);
  };
  return drawing.text(hinge("a", "ground, crank", "[0, 0, 0], [-0.15, 0, 0]", crank_keys) +
                      hinge("b", "crank, coupler", fmt::format("[0.15, 0, 0], [{}, 0, 0]", -coupler / 2), "") +
                      hinge("c", "coupler, rocker", fmt::format("[{}, 0, 0], [0.35, 0, 0]", coupler / 2), "") +
                      hinge("d", "ground, rocker", fmt::format("[{}, 0, 0], [-0.35, 0, 0]", ground), rocker_keys));
}

std::string refusal(const std::string& text, const AssemblyOptions& options = {}) {
  return message_of<bielle::ComputationError>(
      [&] { Session(read_mechanism_text(text, "open.yaml").model).assemble(options); });
}

}  // namespace

TEST_CASE("a rod that is too short leaves its gap in the last joint of the loop") {
  // 0.3 + 0.9 + 0.7 m reach over 1.9 of 2.05 m.
  const std::string said = refusal(four_bar(0.9, 2.05));
  CHECK_THAT(
      said,
      Contains("the mechanism cannot be put together: joint 'd' stays open by 0.15 m whatever the other parts do"));
  CHECK_THAT(said, Contains("it disagrees with joint 'a', joint 'b', joint 'c'"));
}

TEST_CASE("a rod that is too long leaves its gap") {
  // 0.3 and 0.7 m on posts 0.5 m apart: pins are at most 1.5 m from each other.
  CHECK_THAT(refusal(four_bar(1.75, 0.5)), Contains("joint 'd' stays open by 0.25 m"));
}

TEST_CASE("axes that cannot be parallel are told in degrees") {
  const double tilt = 5 * M_PI / 180;
  const std::string text = fmt::format(R"yaml(
nodes: {{a: {{position: [1, 0, 0]}}, b: {{position: [2, 0, 0]}}}}
elements:
  a: {{type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}
  b: {{type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}}
joints:
  first: {{type: rigid, nodes: [ground, a], at: [[1, 0, 0], [0, 0, 0]]}}
  second: {{type: rigid, nodes: [ground, b], at: [[2, 0, 0], [0, 0, 0]]}}
  third: {{type: hinge, nodes: [a, b], at: [[1, 0, 0], [0, 0, 0.2]], axis: [[0, 0, 1], [0, {:.17g}, {:.17g}]]}}
)yaml",
                                       std::sin(tilt), std::cos(tilt));
  CHECK_THAT(refusal(text), Contains("joint 'third' stays open by 0.2 m and 5 degrees") &&
                                Contains("it disagrees with joint 'first', joint 'second'"));
}

TEST_CASE("a start value that loops do not allow is told with its distance") {
  // The rocker of this bar turns until crank and coupler are in line, 1.2 m: cos = (1 + 0.49 - 1.44) / 1.4 at the post.
  const double inner = std::acos((1 + 0.49 - 1.44) / 1.4), least = M_PI - inner;  // from the x axis
  const std::string said = refusal(four_bar(0.9, 1, "", fmt::format(", start: {:.17g}", least - 0.2)));
  CHECK_THAT(said, Contains(fmt::format("the angle of joint 'd' stays {:.4g} degrees away from its start value",
                                        0.2 * 180 / M_PI)));
}

TEST_CASE("a drive beyond the reach of its mechanism is named") {
  const std::string text = four_bar(0.9, 1) + "drives: {push: {joint: d, angle: \"1.3\"}}\n";
  const double least = M_PI - std::acos((1 + 0.49 - 1.44) / 1.4);
  CHECK_THAT(refusal(text), Contains(fmt::format("drive 'push' stays {:.4g} degrees away from what it prescribes",
                                                 (least - 1.3) * 180 / M_PI)));
}

TEST_CASE("what is kept stays where it is, and is named where a loop cannot close for it") {
  const std::string text = four_bar(0.9, 1);
  MechanismFile file = read_mechanism_text(text, "bar.yaml");
  const Component& first = *file.model.components_of({Section::joints, "a"}).front();
  const int rocker = *file.model.find_node("rocker"), crank = *file.model.find_node("crank");
  SECTION("a coordinate") {
    Session session(file.model);
    const double drawn = session.read("joints/a/coordinate")[0];
    AssemblyOptions options;
    options.kept_coordinates.push_back({&first, 0});
    const StartReport report = session.assemble(options);
    CHECK(session.read("joints/a/coordinate")[0] == Approx(drawn).epsilon(1e-11));
    for (const MovedCoordinate& each : report.moved_coordinates) CHECK(each.name != "angle of joint 'a'");
  }
  SECTION("nodes") {
    AssemblyOptions options;
    options.kept_nodes = {rocker, crank};
    const std::string said = message_of<bielle::ComputationError>([&] { Session(file.model).assemble(options); });
    CHECK_THAT(said, Contains("kept, and in the way: ") && Contains("node 'rocker'"));
  }
}

TEST_CASE("a kept node does not move at all while the rest comes to it") {
  Session session(read_mechanism_text(R"yaml(
nodes:
  a: {position: [0.31, 0.02, 0.05], rotation_vector: [0.1, 0.2, 0.3]}
  b: {position: [1.2, -0.1, 0.1], rotation_vector: [-0.3, 0.2, -0.2]}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}
joints: {ball: {type: spherical, nodes: [a, b], at: [[0.4, 0, 0], [-0.4, 0, 0]]}}
)yaml",
                                      "kept.yaml")
                      .model);
  const NodeState a = session.node("a");
  AssemblyOptions options;
  options.kept_nodes = {*session.model().find_node("a")};
  const StartReport report = session.assemble(options);
  CHECK(session.node("a").x == a.x);
  CHECK((session.node("a").R - a.R).norm() < 1e-15);  // made orthonormal again
  const NodeState& b = session.node("b");
  CHECK((a.x + a.R * Vector3(0.4, 0, 0) - b.x - b.R * Vector3(-0.4, 0, 0)).norm() < 1e-12);
  REQUIRE(report.moved_nodes.size() == 1);
  CHECK(report.moved_nodes[0].name == "b");
}

TEST_CASE("a hinge drawn more than a quarter turn off is turned to its right side") {
  for (const double angle : {1.8, 2.5, 3.14159265358979324}) {
    CAPTURE(angle);
    Session session(read_mechanism_text(fmt::format(R"yaml(
nodes: {{m: {{position: [1, 0.1, 0], rotation_vector: [{:.17g}, 0, 0]}}}}
elements: {{m: {{type: rigid_body, node: m, mass: 1, inertia: [1, 1, 1]}}}}
joints: {{main: {{type: hinge, nodes: [ground, m], at: [[0, 0, 0], [-1, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]]}}}}
)yaml",
                                                    angle),
                                        "turned.yaml")
                        .model);
    session.assemble();
    CHECK((session.node("m").R.col(2) - Vector3::UnitZ()).norm() < 1e-12);
  }
}

}  // namespace test_unclosed
