// Shapes that have penetrated each other deeply: no force is correct there, so that the run ends with the name of the
// place.
#include <fstream>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

/// Returns the message with which the run of one body `b` against a shape of the ground ends. @param node  keys of the
/// body's node, in braces
std::string end_of(const std::string& node, const std::string& shape, const std::string& of_ground,
                   const std::string& law = "stiffness: 1e5") {
  const std::string text = contact_model(
      {{"b", node}}, fmt::format("  it: {{type: contact, shapes: [{{node: ground, {}}}, {{node: b, {}}}], {}}}\n",
                                 of_ground, shape, law));
  try {
    run_contact(text, {1e-2, 3}, [](const Session&, const Motion&) {});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "went on";
}

/// A closed cube of edge 1 about the origin.
void write_cube(const std::string& path) {
  std::ofstream file(path);
  file << "solid cube\n";
  const auto triangle = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    file << " facet normal 0 0 0\n  outer loop\n";
    for (const Vector3& p : {a, b, c}) file << "   vertex " << p.x() << " " << p.y() << " " << p.z() << "\n";
    file << "  endloop\n endfacet\n";
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      const Vector3 n = side * Vector3::Unit(axis), u = 0.5 * Vector3::Unit((axis + 1) % 3),
                    v = (side > 0 ? 0.5 : -0.5) * Vector3::Unit((axis + 2) % 3);
      triangle(n - u - v, n + u - v, n + u + v);
      triangle(n - u - v, n + u + v, n - u + v);
    }
  file << "endsolid cube\n";
}

}  // namespace

TEST_CASE("a capsule that is drawn through a box is found, although neither its ends nor corners are inside") {
  // The shortest way out is along x: half of the box plus the capsule's radius.
  for (const char* turn : {"", ", rotation_vector: [0, 0, 0.7]"}) {
    CAPTURE(turn);
    const std::string says =
        end_of(std::string("position: [0, 0, 0]") + turn, "capsule: [0.05, 3]", "box: [0.4, 0.6, 0.8]");
    CHECK_THAT(says, Contains("contact 'it' at t = 0 s") && Contains("box on 'ground'") && Contains("capsule on 'b'") &&
                         Contains("press 0.25 m into each other"));
  }
}

TEST_CASE("boxes that cross each other are found, although no corner of either is inside") {
  const std::string says = end_of("position: [0, 0, 0.02]", "box: [2, 0.2, 0.2]", "box: [0.2, 2, 0.2]");
  CHECK_THAT(says, Contains("box on 'ground' and box on 'b' press 0.18 m into each other"));
}

TEST_CASE(
    "a box that is pushed through a capsule step by step ends the run where its core reaches the capsule's line") {
  // The lower edges, rounded by 0.01, come down at 0.1 m/s from 0.0205 above the capsule of 0.05. The first step that
  // exceeds 0.0205 + 0.06 m ends the run.
  const std::string says =
      end_of("position: [0, 0, 0.1705], motion: {z: '-0.1*t'}", "box: [1, 0.2, 0.2], rounding: 0.01",
             "capsule: [0.05, 1], axes: {x: [1, 0, 0], y: [0, 0, 1]}");
  CHECK_THAT(says, Contains("contact 'it' at t = 0.81 s") && Contains("capsule on 'ground' and box on 'b'") &&
                       Contains("press 0.0605 m into each other, beyond the 0.06 m"));
}

TEST_CASE("balls and capsules that are pushed through each other's middle end the run") {
  // Their middles, 0.2155 m apart, meet after 2.155 s.
  for (const char* shapes : {"sphere: 0.1", "capsule: [0.1, 2]"}) {
    CAPTURE(shapes);
    const std::string of_ground =
        shapes[0] == 's' ? shapes : std::string(shapes) + ", axes: {x: [0, 1, 0], z: [1, 0, 0]}";
    const std::string of_body =
        shapes[0] == 's' ? shapes : std::string(shapes) + ", axes: {x: [1, 0, 0], z: [0, 1, 0]}";
    const std::string says = end_of("position: [0, 0, 0.2155], motion: {z: '-0.1*t'}", of_body, of_ground);
    CHECK_THAT(says, Contains("contact 'it' at t = 2.1") && Contains("on 'ground'") && Contains("on 'b'") &&
                         Contains("each other's middle"));
  }
}

TEST_CASE("balls that are drawn at one place are refused with their names") {
  CHECK_THAT(end_of("position: [0, 0, 0]", "sphere: 0.1", "sphere: 0.2"),
             Contains("joints.it") && Contains("sphere on 'ground' and sphere on 'b'"));
}

TEST_CASE("a ball within a closed surface is found, however far from its faces") {
  const TemporaryFolder folder;
  write_cube(folder.path() + "/cube.stl");
  const std::string cube = "surface: " + folder.path() + "/cube.stl";
  // The place is 0.3 from the nearest face, at x = -0.5, and the radius is 0.1.
  CHECK_THAT(end_of("position: [-0.2, 0.1, -0.1]", "sphere: 0.1", cube),
             Contains("surface on 'ground' and sphere on 'b' press 0.4 m into each other"));
  // The places are outside, near a corner and far away.
  for (const double along : {0.55, 1.0, 40.0}) {
    CAPTURE(along);
    const std::string text = contact_model(
        {{"b", fmt::format("position: [{0}, {0}, {0}]", along)}},
        fmt::format(
            "  it: {{type: contact, shapes: [{{node: ground, {}}}, {{node: b, sphere: 0.02}}], stiffness: 1}}\n",
            cube));
    double gap = 0;
    run_contact(text, {1e-3, 1e-3},
                [&](const Session& session, const Motion&) { gap = session.read("contacts/it/gap")[0]; });
    CHECK_THAT(gap, Catch::WithinRel(std::sqrt(3) * (along - 0.5) - 0.02, 1e-12));
  }
}

TEST_CASE("what has gone through a plane with its middle ends the run, whatever its shape") {
  // The shape is pushed down at 0.1 m/s from 0.2055 m above the plane. The run ends with the first step in which its
  // middle is beyond the plane.
  const TemporaryFolder folder;
  write_cube(folder / "cube.stl");
  for (const std::string& shape :
       {std::string("sphere: 0.1"), std::string("capsule: [0.1, 0.3]"), std::string("cylinder: [0.1, 0.3]"),
        std::string("box: [0.2, 0.3, 0.4]"), "surface: \"" + folder / "cube.stl" + "\""}) {
    CAPTURE(shape);
    const std::string says = end_of("position: [0, 0, 0.2055], motion: {z: '-0.1*t'}", shape, "plane: [0, 0, 1]");
    CHECK_THAT(says, Contains("contact 'it' at t = 2.06 s") && Contains("has gone through plane on 'ground'") &&
                         Contains("with its middle, which is 0.0005 m behind it; make the contact stiffer"));
  }
  // The run also ends if the plane moves, and if the middle of a shape is not its node.
  const std::string moved =
      end_of("position: [0, 0, 0.5], motion: {z: '-0.1*t'}", "sphere: 0.1, at: [0, 0, -0.2945]", "plane: [0, 0, 1]");
  CHECK_THAT(moved, Contains("at t = 2.06 s") && Contains("sphere on 'b' has gone through"));
  // A shape that is drawn with its middle behind the plane ends the run at once; a shape that rests on it does not.
  CHECK_THAT(end_of("position: [0, 0, -0.01]", "sphere: 0.1", "plane: [0, 0, 1]"),
             Contains("at t = 0 s") && Contains("0.01 m behind it"));
  CHECK(end_of("position: [0, 0, 0.05], motion: {z: 0}", "sphere: 0.1", "plane: [0, 0, 1]") == "went on");
}

TEST_CASE("a ball on a floor that is far too soft ends where its middle meets the floor") {
  // The shape falls from 0.01 m above the floor, whose force is small: 0.11 m in 0.1498 s.
  const std::string text = contact_model(
      {{"b", "position: [0, 0, 0.11]"}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: b, sphere: 0.1}], stiffness: 1}\n",
      "[0, 0, -9.81]");
  std::string says;
  try {
    run_contact(text, {1e-3, 0.5}, [](const Session&, const Motion&) {});
  } catch (const std::exception& error) {
    says = error.what();
  }
  CHECK_THAT(says, Contains("contact 'it' at t = 0.15 s: sphere on 'b' has gone through plane on 'ground'"));
}
