// Springs, loads, cylinders, stiffness fields and contacts as they are drawn.
#include "tests/unit/mechanism/drawing/drawn_model.hpp"

namespace test_drawn_forces {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;

const std::string two_nodes =
    "nodes: {a: {position: [1, 0, 0], rotation_vector: [0, 0, pi/2]}, b: {position: [3, 0, 0]}}\n"
    "elements:\n"
    "  a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}\n"
    "  b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}\n";

TEST_CASE("springs and dampers are drawn between their points by what they have") {
  const std::string at = "nodes: [a, b], at: [[1, 0, 0], [0, 0, 2]], ";
  const DrawnModel drawn(two_nodes + "  s: {type: spring_damper, " + at + "stiffness: 10}\n" +
                         "  d: {type: spring_damper, " + at + "damping: 1}\n" + "  both: {type: spring_damper, " + at +
                         "stiffness: 10, damping: 1}\n" + "  formula: {type: spring_damper, " + at + "force: '3*e'}\n");
  for (const auto& [name, shape] :
       {std::pair{"s", "coil"}, {"d", "damper"}, {"both", "coil_damper"}, {"formula", "coil"}}) {
    const DrawnItem& item = drawn.one(std::string("elements/") + name, shape);
    CHECK(item.type == "spring_damper");
    CHECK(drawn.at(item, 0).x.isApprox(Vector3(1, 1, 0), 1e-14));  // the node's x points along y
    CHECK(drawn.at(item, 1).x.isApprox(Vector3(3, 0, 2), 1e-14));
  }
}

TEST_CASE("loads, forces and stiffness fields are drawn at their nodes") {
  const DrawnModel drawn(
      two_nodes +
      "  pair: {type: node_force, nodes: [a, b], at: [0, 1, 0], force: [1, 0, 0]}\n"
      "  cylinder: {type: hydraulic_actuator, nodes: [a, b], at: [[0, 0, 0], [0.5, 0, 0]], stroke: "
      "[2, 4], piston_areas: [5e-3, 3e-3], dead_volumes: [1e-4, 1e-4], supply: {pressure: 2e7, tank: "
      "101325}, valve: {area: 1e-5, command: 0}}\n"
      "loads: {push: {node: a, at: [2, 0, 0], force: [0, 0, 1]}}\n");
  CHECK(drawn.at(drawn.one("loads/push", "force")).x.isApprox(Vector3(1, 2, 0), 1e-14));
  CHECK(drawn.at(drawn.one("elements/pair", "force")).x.isApprox(Vector3(3, 1, 0), 1e-14));
  const DrawnItem& jack = drawn.one("elements/cylinder", "jack");
  CHECK(list_of(jack, "stroke") == std::vector<double>{2, 4});
  CHECK(number_of(jack, "radius") == Approx(std::sqrt(5e-3 / 3.14159265358979)).epsilon(1e-12));  // the piston
  CHECK(drawn.at(jack, 1).x.isApprox(Vector3(3.5, 0, 0), 1e-14));
}

TEST_CASE("shapes of contacts are drawn with their role") {
  const DrawnModel drawn(
      two_nodes +
      "joints: {it: {type: contact, between: [[{node: ground, plane: [0, 0, 1], at: [0, 0, -5]}], "
      "[{node: a, sphere: 0.1}, {node: a, box: [0.1, 0.2, 0.3], at: [2, 0, 0]}, "
      "{node: b, cylinder: [0.1, 0.5]}, {node: b, capsule: [0.1, 0.4], at: [0, 5, 0]}]], stiffness: 1e6}}\n");
  const DrawnItem& plane = drawn.one("joints/it", "plane");
  CHECK(plane.role == "contact");
  CHECK(drawn.at(plane).x.isApprox(Vector3(0, 0, -5), 1e-14));
  CHECK(drawn.at(plane).R.col(2).isApprox(Vector3(0, 0, 1), 1e-14));
  const DrawnItem& box = drawn.one("joints/it", "box");
  CHECK(list_of(box, "size") == std::vector<double>{0.1, 0.2, 0.3});
  CHECK(drawn.at(box).x.isApprox(Vector3(1, 2, 0), 1e-14));
  const auto cylinders = drawn.all("joints/it", "cylinder");
  REQUIRE(cylinders.size() == 2);
  CHECK(number_of(*cylinders[0], "length") == 0.5);
  CHECK(number_of(*cylinders[1], "length") == 0.4);  // between the middles of the capsule's ends
  const auto spheres = drawn.all("joints/it", "sphere");
  REQUIRE(spheres.size() == 3);
  CHECK(drawn.at(*spheres[1]).x.isApprox(Vector3(3, 5, -0.2), 1e-14));
  CHECK(drawn.at(*spheres[2]).x.isApprox(Vector3(3, 5, 0.2), 1e-14));
}

}  // namespace test_drawn_forces
