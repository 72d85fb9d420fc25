// Shapes of bodies, nodes and beams: each is where the body's geometry is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanism/elements/beam/section_outline.hpp"
#include "mechanism/elements/beam/section_shape.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/drawing/drawn_model.hpp"

namespace test_drawn_bodies {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Detail::Approx;

constexpr double pi = std::numbers::pi;

/// A quarter turn about x maps z to -y; the node is turned by a quarter about z and stands at (1, 2, 3).
const std::string node_a = "nodes: {a: {position: [1, 2, 3], rotation_vector: [0, 0, pi/2]}}\n";

TEST_CASE("a solid is drawn where it is") {
  const DrawnModel drawn(node_a +
                         "elements: {it: {type: rigid_body, node: a, solid: {cylinder: [0.1, 0.6], density: 7800, "
                         "position: [0.2, 0, 0], rotation_vector: [pi/2, 0, 0]}}}\n");
  const DrawnItem& item = drawn.one("elements/it", "cylinder");
  CHECK(item.type == "rigid_body");
  CHECK(number_of(item, "radius") == 0.1);
  CHECK(number_of(item, "length") == 0.6);
  const Frame at = drawn.at(item);
  CHECK(at.x.isApprox(Vector3(1, 2.2, 3), 1e-14));       // [0.2, 0, 0] along the node's x, which points along y
  CHECK(at.R.col(2).isApprox(Vector3(1, 0, 0), 1e-14));  // z -> -y of the node -> x
  CHECK_FALSE(drawn.has("elements/it", "body"));
}

TEST_CASE("all forms of solids are drawn, and those that are cut out have this role") {
  const DrawnModel drawn(
      node_a +
      "elements: {it: {type: rigid_body, node: a, solid: [{box: [1, 2, 3], density: 1}, "
      "{cylinder: [0.1, 3], density: 1, cut: true}, {tube: [0.4, 0.3, 2], density: 1}, "
      "{cone: [0.2, 0, 1], density: 1}, {sphere: 0.5, density: 1}, {ring: [1, 0.25], density: 1}]}}\n");
  CHECK(list_of(drawn.one("elements/it", "box"), "size") == std::vector<double>{1, 2, 3});
  CHECK(drawn.one("elements/it", "box").role.empty());
  const DrawnItem& cut = drawn.one("elements/it", "cylinder");
  CHECK(cut.role == "cut");
  CHECK(number_of(cut, "radius") == 0.1);
  CHECK(number_of(cut, "length") == 3);
  const DrawnItem& tube = drawn.one("elements/it", "tube");
  CHECK(number_of(tube, "radius") == 0.4);
  CHECK(number_of(tube, "inner_radius") == 0.3);
  CHECK(number_of(tube, "length") == 2);
  CHECK(list_of(drawn.one("elements/it", "cone"), "radii") == std::vector<double>{0.2, 0});
  CHECK(number_of(drawn.one("elements/it", "sphere"), "radius") == 0.5);
  CHECK(drawn.one("elements/it", "mesh").mesh->name == "ring");
}

TEST_CASE("a solid without a position is drawn at the given centre of mass") {
  const DrawnModel drawn(
      node_a + "elements: {it: {type: rigid_body, node: a, centre: [0, 0, 1], solid: {sphere: 0.1, mass: 1}}}\n");
  CHECK(drawn.at(drawn.one("elements/it", "sphere")).x.isApprox(Vector3(1, 2, 4), 1e-14));
}

TEST_CASE("bodies without a solid have bars from their centre, unless they have a shape") {
  const DrawnModel drawn(
      node_a +
      "elements:\n"
      "  plain: {type: rigid_body, node: a, mass: 2, centre: [0.1, 0.2, 0.3], inertia: [1, 1, 1]}\n"
      "  point: {type: point_mass, node: a, mass: 1, centre: [0, 0, 1]}\n"
      "  shaped: {type: rigid_body, node: a, mass: 2, inertia: [1, 1, 1], shape: [{box: [1, 1, 1], colour: Red}, "
      "{sphere: 2, opacity: 0.25, colour: '#12ABef'}]}\n"
      "  ball: {type: point_mass, node: a, mass: 1, shape: {sphere: 0.1}}\n"
      "  solid: {type: rigid_body, node: a, solid: {sphere: 1, mass: 1}, shape: {box: [2, 2, 2]}}\n");
  CHECK(list_of(drawn.one("elements/plain", "body"), "centre") == std::vector<double>{0.1, 0.2, 0.3});
  CHECK(list_of(drawn.one("elements/point", "body"), "centre") == std::vector<double>{0, 0, 1});
  CHECK_FALSE(drawn.has("elements/shaped", "body"));
  CHECK(drawn.one("elements/shaped", "box").colour == "#ff0000");
  CHECK(drawn.one("elements/shaped", "box").opacity == 1);
  CHECK(drawn.one("elements/shaped", "sphere").colour == "#12abef");
  CHECK(drawn.one("elements/shaped", "sphere").opacity == 0.25);
  CHECK(drawn.one("elements/ball", "sphere").type == "point_mass");
  CHECK_FALSE(drawn.has("elements/solid", "sphere"));  // the shape replaces the solid
  CHECK(drawn.has("elements/solid", "box"));
}

TEST_CASE("nodes are drawn with their shapes and their supports") {
  const DrawnModel drawn(
      "nodes:\n"
      "  base: {fixed: true, shape: {box: [1, 1, 0.1], position: [0, 0, -0.05]}}\n"
      "  slide: {position: [1, 0, 0], fixed: [y, z], motion: {x: 'sin(t)'}}\n"
      "  mass: {position: [2, 0, 0], fixed: [rx, ry, rz]}\n"
      "elements: {m: {type: point_mass, node: mass, mass: 1}, b: {type: rigid_body, node: slide, mass: 1, inertia: [1, "
      "1, 1]}}\n");
  CHECK(drawn.at(drawn.one("nodes/base", "box")).x.isApprox(Vector3(0, 0, -0.05), 1e-14));
  CHECK(drawn.one("nodes/base", "box").type == "node");
  const auto fixed = [&](const std::string& node) {
    return value_of<std::vector<std::string>>(drawn.one("nodes/" + node, "support"), "fixed");
  };
  CHECK(fixed("base") == std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"});
  CHECK(fixed("slide") == std::vector<std::string>{"y", "z"});
  CHECK(value_of<std::vector<std::string>>(drawn.one("nodes/slide", "support"), "moved") ==
        std::vector<std::string>{"x"});
  CHECK(drawn.one("nodes/base", "support").role == "support");
  CHECK(drawn.has("nodes/mass", "node"));
  CHECK_FALSE(drawn.has("nodes/mass", "support"));  // a point mass has no rotation to support
}

TEST_CASE("held rotations are drawn with the axes in which they are held") {
  const DrawnModel drawn(
      "nodes:\n"
      "  column: {position: [0, 0, 3], fixed: [rz]}\n"
      "  leaning: {position: [1, 0, 3], rotation_vector: [0, 0.6, 0], fixed: [rz], fixed_axes: own}\n"
      "elements:\n"
      "  a: {type: rigid_body, node: column, mass: 1, inertia: [1, 1, 1]}\n"
      "  b: {type: rigid_body, node: leaning, mass: 1, inertia: [1, 1, 1]}\n");
  for (const std::string node : {"column", "leaning"})
    CHECK(value_of<std::vector<std::string>>(drawn.one("supports/" + node, "support"), "fixed") ==
          std::vector<std::string>{"rz"});
  const std::vector<double> axes = value_of<std::vector<double>>(drawn.one("supports/leaning", "support"), "axes");
  REQUIRE(axes.size() == 4);
  CHECK(axes[0] == Approx(std::cos(0.3)));
  CHECK(axes[2] == Approx(std::sin(0.3)));
  const auto& values = drawn.one("supports/column", "support").values;
  CHECK(std::none_of(values.begin(), values.end(), [](const auto& value) { return value.first == "axes"; }));
}

/// Returns the area and centroid of a polygon by the theorem of Green.
std::array<double, 3> area_of(const DrawnOutline& outline) {
  double area = 0, y = 0, z = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
    const double cross = a[0] * b[1] - b[0] * a[1];
    area += cross / 2;
    y += (a[0] + b[0]) * cross / 6;
    z += (a[1] + b[1]) * cross / 6;
  }
  return {area, y / area, z / area};
}

TEST_CASE("outlines of sections have the area of the section, and its centroid at the offset") {
  struct Case {
    const char* shape;
    VectorX sizes;
    double area;
  };
  const double r = 0.1, chord = 16 * std::sin(pi / 16);  // a polygon of 32 sides has the area chord r^2
  const auto sizes = [](std::initializer_list<double> values) {
    VectorX v(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), v.data());
    return v;
  };
  const std::vector<Case> cases = {
      {"rectangle", sizes({0.2, 0.3}), 0.06},
      {"circle", sizes({r}), chord * r * r},
      {"tube", sizes({r, 0.06}), chord * (r * r - 0.06 * 0.06)},
      {"i", sizes({0.2, 0.1, 0.3, 0.01, 0.02, 0.03}), 0.2 * 0.02 + 0.1 * 0.03 + 0.25 * 0.01},
      {"t", sizes({0.2, 0.3, 0.01, 0.02}), 0.2 * 0.02 + 0.28 * 0.01},
      {"l", sizes({0.2, 0.3, 0.02, 0.01}), 0.2 * 0.02 + 0.28 * 0.01},
      {"box", sizes({0.2, 0.3, 0.01, 0.02}), 0.06 - 0.18 * 0.26}};
  const Vector2 offset(0.5, -0.7);
  for (const Case& each : cases) {
    CAPTURE(each.shape);
    const DrawnSection section = section_outline(each.shape, each.sizes, offset);
    const auto outer = area_of(section.outer);
    const auto inner = section.inner.empty() ? std::array<double, 3>{0, 0, 0} : area_of(section.inner);
    CHECK(outer[0] - inner[0] == Approx(each.area).epsilon(1e-13));
    for (const std::size_t axis : {1, 2})
      CHECK((outer[0] * outer[axis] - inner[0] * inner[axis]) / each.area ==
            Approx(offset[static_cast<int>(axis) - 1]).epsilon(1e-12));
  }
}

TEST_CASE("beams have the sections of their taper along them, and none if constants define them") {
  const std::string material = ", young: 2e11, poisson: 0.3, density: 7800}";
  const auto beam = [&](const std::string& name, const std::string& section) {
    return "  " + name + ": {type: beam, nodes: [a, b], elements: 3, section: " + section + "}\n";
  };
  const auto taper = [&](const std::string& start, const std::string& end) {
    return "[{" + start + material + ", {" + end + material + "]";
  };
  const DrawnModel drawn("nodes: {a: {fixed: true}, b: {position: [2, 0, 0]}}\nelements:\n" +
                         beam("uniform", "{tube: [0.1, 0.09]" + material) +
                         beam("taper", taper("rectangle: [0.4, 0.2]", "rectangle: [0.2, 0.1]")) +
                         beam("tee", taper("t: {width: 0.2, height: 0.3, web: 0.02, flange: 0.03}",
                                           "t: {width: 0.1, height: 0.1, web: 0.02, flange: 0.01}")) +
                         beam("plain", "{EA: 1e6, GAy: 1e6, GAz: 1e6, GJ: 1e3, EIy: 1e3, EIz: 1e3}"));
  const DrawnItem& uniform = drawn.one("elements/uniform", "beam");
  CHECK(value_of<std::string>(uniform, "element") == "elements/uniform");
  CHECK(uniform.type == "beam");
  REQUIRE(uniform.sections.size() == 2);
  CHECK(uniform.sections.back().at == 1);
  CHECK_FALSE(uniform.sections.front().inner.empty());
  const DrawnItem& linear = drawn.one("elements/taper", "beam");
  REQUIRE(linear.sections.size() == 2);  // straight lines between them are the taper
  CHECK(area_of(linear.sections[0].outer)[0] == Approx(0.08));
  CHECK(area_of(linear.sections[1].outer)[0] == Approx(0.02));
  const DrawnItem& tee = drawn.one("elements/tee", "beam");
  REQUIRE(tee.sections.size() == 17);
  for (const DrawnSection& section : tee.sections) {
    const double s = section.at, flange = 0.03 - 0.02 * s;
    const auto [area, y, z] = area_of(section.outer);
    CHECK(area == Approx((0.2 - 0.1 * s) * flange + 0.02 * (0.3 - 0.2 * s - flange)));
    CHECK(y == Approx(0).margin(1e-14));
    CHECK(z == Approx(0).margin(1e-14));
  }
  CHECK(drawn.one("elements/plain", "beam").sections.empty());
}

TEST_CASE("beams tell how their sections are turned against the axes of their end nodes") {
  const DrawnModel drawn(
      "nodes: {a: {fixed: true}, b: {position: [2, 0, 0], rotation_vector: [0, 0, pi/2]}}\nelements:\n"
      "  it: {type: beam, nodes: [a, b], elements: 3, orientation: [0, 1, 0], twist: pi/2, section: {circle: 0.1, "
      "young: 2e11, poisson: 0.3, density: 7800}}\n");
  const auto turn = value_of<std::vector<std::vector<double>>>(drawn.one("elements/it", "beam"), "turn");
  REQUIRE(turn.size() == 2);
  const auto axes = [&](std::size_t end) {
    return rotation_of_quaternion(Eigen::Vector4d(turn[end][0], turn[end][1], turn[end][2], turn[end][3]));
  };
  CHECK((axes(0) - Matrix3::Identity()).norm() < 1e-14);
  // The section at the end is turned by a quarter about x, the node by a quarter about z.
  const Matrix3 node = exp_so3(Vector3(0, 0, std::numbers::pi / 2)),
                section = exp_so3(Vector3(std::numbers::pi / 2, 0, 0));
  CHECK((node * axes(1) - section).norm() < 1e-14);
}

/// Returns the volume inside of a closed surface whose triangles are anticlockwise seen from outside.
double volume_of(const DrawnMesh& mesh) {
  double volume = 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = mesh.points[static_cast<std::size_t>(triangle[k])];
      corner[k] = Vector3(p[0], p[1], p[2]);
    }
    volume += corner[0].dot(corner[1].cross(corner[2])) / 6;
  }
  return volume;
}

TEST_CASE("a ring is a closed mesh of the right volume") {
  const DrawnModel drawn(node_a + "elements: {it: {type: point_mass, node: a, mass: 1, shape: {ring: [1, 0.25]}}}\n");
  const DrawnMesh& mesh = *drawn.one("elements/it", "mesh").mesh;
  // 48 straight pieces, each of which sweeps sin(2 pi/48) times the section's first moment; the section is a 16-gon.
  const double section = 8 * 0.25 * 0.25 * std::sin(pi / 8);
  CHECK(volume_of(mesh) == Approx(48 * std::sin(pi / 24) * section).epsilon(1e-6));  // single precision
}

/// A tetrahedron with edges along the axes, as a text.
const std::string tetrahedron = [] {
  const std::vector<std::array<std::string, 3>> faces = {{"0 0 0", "0 2000 0", "1000 0 0"},
                                                         {"0 0 0", "1000 0 0", "0 0 3000"},
                                                         {"0 0 0", "0 0 3000", "0 2000 0"},
                                                         {"1000 0 0", "0 2000 0", "0 0 3000"}};
  std::string text = "solid t\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::string& corner : face) text += "vertex " + corner + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}();

TEST_CASE("corners of an STL file that are equal become one point, in metres") {
  const TemporaryFolder folder;
  folder.file("a part.v2.stl", tetrahedron);
  const DrawnModel drawn(
      node_a + "elements: {it: {type: point_mass, node: a, mass: 1, shape: {stl: 'a part.v2.stl', scale: 0.001}}}\n",
      folder / "model.yaml");
  const DrawnMesh& mesh = *drawn.one("elements/it", "mesh").mesh;
  CHECK(mesh.name == "a_part_v2");
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.triangles.size() == 4);
  CHECK(volume_of(mesh) == Approx(1).epsilon(1e-6));
}

}  // namespace test_drawn_bodies
