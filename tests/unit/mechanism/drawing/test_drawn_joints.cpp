// Drawings of joints, and of the parts that move on lines, curves and beams.
#include <fstream>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/drawing/drawn_model.hpp"

namespace test_drawn_joints {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Detail::Approx;

const std::string two_bodies =
    "nodes: {a: {position: [1, 2, 3], rotation_vector: [0.3, -0.5, 0.8]}, b: {position: [4, 5, 6], rotation_vector: "
    "[-0.7, 0.2, 0.4]}}\n"
    "elements:\n"
    "  a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}\n"
    "  b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}\n";

TEST_CASE("a joint is drawn at its position along its axis, on both nodes") {
  const Vector3 z = Vector3(1, 2, 2) / 3;
  for (const std::string type :
       {"hinge", "prismatic", "cylindrical", "planar", "rigid", "screw", "bearing", "bushing"}) {
    CAPTURE(type);
    std::string keys = type == "screw"     ? ", pitch: 0.1"
                       : type == "bearing" ? ", radial: 1e6"
                       : type == "bushing" ? ", stiffness: [1, 1, 1, 1, 1, 1]"
                                           : "";
    const DrawnModel drawn(two_bodies + "joints: {it: {type: " + type +
                           ", nodes: [a, b], position: [0.1, 0.2, 0.3], axis: [1, 2, 2]" + keys + "}}\n");
    const DrawnItem& item = drawn.one("joints/it", "joint");
    CHECK(item.type == type);
    REQUIRE(item.places.size() == 2);
    for (const std::size_t k : {0, 1}) {
      CHECK(drawn.at(item, k).x.isApprox(Vector3(0.1, 0.2, 0.3), 1e-13));
      CHECK(drawn.at(item, k).R.col(2).isApprox(z, 1e-13));
    }
    CHECK(item.places[0].node != item.places[1].node);
  }
}

TEST_CASE("what acts in a joint adds nothing to its drawing") {
  const DrawnModel drawn(
      two_bodies +
      "joints: {it: {type: hinge, nodes: [a, b], position: [0, 0, 0], axis: [0, 0, 1], stiffness: 3, "
      "stops: {range: [-1, 1], stiffness: 1e4}, friction: {coefficient: 0.1, radius: 0.1, velocity: 0.1}}}\n"
      "drives: {motor: {joint: it, torque: 1}}\n");
  CHECK(drawn.all("joints/it", "joint").size() == 1);
  CHECK(drawn.all("drives/motor", "joint").empty());
}

TEST_CASE("rods are bars between their points") {
  const std::string at = ", nodes: [a, b], at: [[0, 0, 0], [0, 0, 0]]";
  for (const std::string type : {"distance", "spherical_spherical", "revolute_spherical"}) {
    CAPTURE(type);
    const DrawnModel drawn(two_bodies + "joints: {it: {type: " + type + at +
                           (type == "revolute_spherical" ? ", axis: [1, 0, 0]" : "") + "}}\n");
    const DrawnItem& bar = drawn.one("joints/it", "bar");
    CHECK(drawn.at(bar, 0).x.isApprox(Vector3(1, 2, 3), 1e-14));
    CHECK(drawn.at(bar, 1).x.isApprox(Vector3(4, 5, 6), 1e-14));
    CHECK(drawn.has("joints/it", "joint") == (type == "revolute_spherical"));
  }
}

TEST_CASE("a plane that guides a point has its normal") {
  const DrawnModel drawn(two_bodies + "joints: {it: {type: point_on_plane, nodes: [a, b], normal: [0, 3, 4]}}\n");
  const DrawnItem& plane = drawn.one("joints/it", "plane");
  CHECK(drawn.at(plane).R.col(2).isApprox(Vector3(0, 0.6, 0.8), 1e-13));
}

TEST_CASE("a curve is drawn through its points") {
  const TemporaryFolder folder;
  folder.file("curve.csv", "4, 5, 6\n5, 5, 6\n6, 6, 6\n6, 7, 8\n");
  const DrawnModel drawn(two_bodies + "joints: {it: {type: point_on_curve, nodes: [a, b], curve: curve.csv}}\n",
                         folder / "model.yaml");
  const DrawnItem& curve = drawn.one("joints/it", "curve");
  CHECK_FALSE(value_of<bool>(curve, "closed"));
  const auto& points = value_of<std::vector<std::vector<double>>>(curve, "points");
  const Frame at = drawn.at(curve);
  const auto inertial = [&](const std::vector<double>& p) -> Vector3 {
    return at.x + at.R * Vector3(p[0], p[1], p[2]);
  };
  CHECK(inertial(points.front()).isApprox(Vector3(4, 5, 6), 1e-12));
  CHECK(inertial(points.back()).isApprox(Vector3(6, 7, 8), 1e-12));
  double nearest = 1;
  for (const auto& point : points) nearest = std::min(nearest, (inertial(point) - Vector3(5, 5, 6)).norm());
  CHECK(nearest < 0.02);
}

TEST_CASE("a slider is drawn at its place, and a joint inside of a beam names the beam") {
  const std::string section =
      "section: {EA: 1e6, GAy: 1e6, GAz: 1e6, GJ: 1e3, EIy: 1e3, EIz: 1e3, mass_per_length: 1, Jx: 1, Jy: 1, Jz: 1}";
  const DrawnModel drawn(
      "nodes: {a: {fixed: true}, b: {position: [4, 0, 0]}, ring: {position: [1.5, 0, 0], fixed: [rx, ry, rz]}}\n"
      "elements: {beam: {type: beam, nodes: [a, b], elements: 4, " +
      section +
      "}, m: {type: point_mass, node: ring, mass: 1}}\n"
      "joints: {it: {type: slider, node: ring, beam: beam}}\n"
      "loads: {push: {node: beam.2, force: [0, 0, 1]}}\n");
  const DrawnItem& slider = drawn.one("joints/it", "joint");
  for (const std::size_t k : {0, 1}) CHECK(drawn.at(slider, k).x.isApprox(Vector3(1.5, 0, 0), 1e-12));
  CHECK(drawn.at(drawn.one("loads/push", "force")).x.isApprox(Vector3(2, 0, 0), 1e-12));
  CHECK_FALSE(drawn.has("nodes/beam.2", "node"));
}

}  // namespace test_drawn_joints
