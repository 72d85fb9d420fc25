// Boxes, cylinders, capsules and planes on surfaces of triangles: compared with planes and balls of the same shape, and
// with closed forms.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/so3.hpp"
#include "reduce/common/error.hpp"
#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/placed_shapes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/triangulated.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

/// Returns positions and rotations of node `b` at the end of a run of it above the ground's shape.
NodeState end_on(const std::string& ground, const std::string& node, const std::string& shape, const std::string& law,
                 double end, double h = 1e-3) {
  NodeState state;
  run_contact(
      contact_model({{"b", node, 2, {0.03, 0.04, 0.02}}},
                    fmt::format("  it: {{type: contact, shapes: [{{node: ground, {}}}, {{node: b, {}}}], {}}}\n",
                                ground, shape, law),
                    "[0, 0, -9.81]"),
      {h, end}, [&](const Session& session, const Motion&) { state = session.node("b"); });
  return state;
}

}  // namespace

TEST_CASE("what tumbles, slides and lies on a floor of triangles does as on a plane") {
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/floor.stl", floor_of_triangles(2, 6));
  const std::string floor = "surface: " + folder.path() + "/floor.stl";
  struct Case {
    const char *shape, *node;
  };
  const char* tumbling =
      "position: [0.1, 0.2, 0.5], velocity: [1, 0.5, -1], rotation_vector: [0.4, 0.3, 0.1], "
      "angular_velocity: [2, -3, 1]";
  for (const auto& [shape, node] : {Case{"box: [0.4, 0.3, 0.5]", tumbling}, Case{"cylinder: [0.2, 0.5]", tumbling},
                                    Case{"capsule: [0.1, 0.5]", tumbling},
                                    Case{"box: [0.4, 0.3, 0.2]", "position: [0, 0, 0.1], velocity: [1, 0, 0]"}}) {
    CAPTURE(shape, node);
    const std::string law = "stiffness: 3e6, damping: 0.3, friction: {coefficient: 0.3, velocity: 1e-2}";
    const NodeState on_plane = end_on("plane: [0, 0, 1]", node, shape, law, 0.6, 5e-4),
                    on_floor = end_on(floor, node, shape, law, 0.6, 5e-4);
    CHECK((on_plane.x - on_floor.x).norm() < 1e-7);
    CHECK((on_plane.R - on_floor.R).norm() < 1e-6);
  }
}

TEST_CASE("a block slides down a wedge of triangles that slides itself") {
  // Without friction the wedge of mass M under the slope a moves at m g sin a cos a/(M + m sin^2 a).
  constexpr double a = 0.4, M = 3, m = 2;
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/wedge.stl", wedge_of_triangles(4, a, 0.5));
  const double depth = std::pow(m * g * std::cos(a) / (1 + m / M * std::pow(std::sin(a), 2)) / 4e7, 1 / 1.5);
  const Vector3 on_slope(3, 0, 3 * std::tan(a)), up(-std::sin(a), 0, std::cos(a));
  const Vector3 at = on_slope + (0.1 - depth) * up;
  const std::string text = contact_model(
      {{"wedge", "position: [0, 0, 0]", M},
       {"block", fmt::format("position: [{:.17g}, 0, {:.17g}], rotation_vector: [0, {}, 0]", at.x(), at.z(), -a), m}},
      "  guide: {type: prismatic, nodes: [ground, wedge], axis: [1, 0, 0]}\n  it: {type: contact, shapes: [{node: "
      "wedge, surface: " +
          folder.path() + "/wedge.stl}, {node: block, box: [0.4, 0.3, 0.2]}], stiffness: 1e7, damping: 1}\n",
      "[0, 0, -9.81]");
  double x = 0, v = 0, wedge = 0;
  constexpr double t = 0.5;
  run_contact(text, {1e-3, t}, [&](const Session& session, const Motion&) {
    wedge = session.node("wedge").v.x();
    v = session.node("block").v.x();
    x = session.node("block").R(2, 0);
  });
  const double expected = m * g * std::sin(a) * std::cos(a) / (M + m * std::pow(std::sin(a), 2));
  CHECK(wedge == Approx(expected * t).epsilon(1e-4));
  CHECK(M * wedge + m * v == Approx(0).margin(1e-9));
  CHECK(x == Approx(std::sin(a)).margin(1e-4));  // it does not tip
}

TEST_CASE("a capsule on a ball of triangles is as near as on the ball, as these get finer") {
  const ContactShape capsule = round_shape(ContactShape::Kind::capsule, 0.05, 0.4);
  double before = 0;
  for (const int levels : {1, 2, 3, 4}) {
    const ContactShape ball = surface_shape(ball_of_triangles(0.3, levels));
    double worst = 0;
    for (int way = 0; way < 40; ++way) {
      // The capsules are placed around the ball, with their line along a tangent.
      const Matrix3 A = exp_so3(Vector3(0.37 * way, 0.2 + 0.61 * way, -0.43 * way));
      const double gap = 0.3 + 0.05 + 1e-3;
      const Touch<double> found =
          find_nearest_place(placed_at(ball, Vector3::Zero()), placed_at(capsule, gap * A.col(0), A));
      worst = std::max(worst, -found.depth - 1e-3);
      CHECK(-found.depth > 1e-3 - 1e-12);  // triangles are within the ball
    }
    if (levels > 1) CHECK(before / worst == Approx(4).epsilon(0.35));  // the sagitta of edges half as long
    before = worst;
  }
}

TEST_CASE("a body of triangles stands on a plane as its box does, wherever the plane is") {
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/brick.stl", box_of_triangles({0.2, 0.15, 0.1}));
  const std::string brick = "surface: " + folder.path() + "/brick.stl";
  const std::string node = "position: [0.1, 0, 0.3], velocity: [0.5, 0, 0], rotation_vector: [0.02, 0.03, 0]";
  const NodeState end =
      end_on("plane: [0, 0, 1]", node, brick, "stiffness: 1e5, damping: 4, friction: {coefficient: 0.5}", 3);
  CHECK(end.x.z() == Approx(0.1 - std::pow(2 * g / 4e5, 1 / 1.5)).margin(2e-6));
  // A moving plane carries the body up.
  const std::string text = contact_model({{"b", "position: [0, 0, 0.1]", 2, {0.03, 0.04, 0.02}}},
                                         "  it: {type: contact, shapes: [{node: lift, plane: [0, 0, 1]}, {node: b, " +
                                             brick + "}], stiffness: 1e6, damping: 1}\n",
                                         "[0, 0, -9.81]");
  const std::string moving = std::string(text).insert(
      text.find("nodes:\n") + 7, "  lift: {position: [0, 0, 0], fixed: [x, y, rx, ry, rz], motion: {z: '0.3*t'}}\n");
  double z = 0;
  run_contact(moving, {1e-3, 1}, [&](const Session& session, const Motion&) { z = session.node("b").x.z(); });
  CHECK(z == Approx(0.4 - std::pow(2 * g / 4e6, 1 / 1.5)).margin(2e-5));
}

TEST_CASE("a box that tumbles over a block of triangles keeps its energy without friction") {
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/brick.stl", box_of_triangles({0.2, 0.3, 0.2}));
  for (const char* shape :
       {"box: [0.3, 0.3, 0.3], rounding: 0.03", "cylinder: [0.15, 0.4], rounding: 0.03", "capsule: [0.1, 0.4]"}) {
    CAPTURE(shape);
    const std::string text = contact_model({{"b",
                                             "position: [0.15, 0.1, 0.6], velocity: [-0.2, 0.1, -2], rotation_vector: "
                                             "[0.6, 0.4, 0.3], angular_velocity: [2, -3, 1]",
                                             2,
                                             {0.03, 0.04, 0.02}}},
                                           "  it: {type: contact, shapes: [{node: ground, surface: " + folder.path() +
                                               "/brick.stl}, {node: b, " + shape + "}], stiffness: 1e6}\n");
    double worst = 0;
    int touches = 0;
    run_contact(text, {2e-5, 0.4, 0, 1}, [&](const Session& session, const Motion& motion) {
      worst = std::max(worst, std::abs(motion.balance()));
      if (session.read("contacts/it/state")[0] > 0) ++touches;
    });
    CHECK(touches > 5);
    CHECK(worst < 1e-4 * 4);  // energies are some 4 J
  }
}

TEST_CASE("what is drawn through a surface, or within it, is told with its names") {
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/brick.stl", box_of_triangles({0.5, 0.5, 0.5}));
  const std::string brick = "surface: " + folder.path() + "/brick.stl";
  const auto says = [&](const std::string& shape, const std::string& node) -> std::string {
    try {
      end_on(brick, node, shape, "stiffness: 1e5", 0.01);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "went on";
  };
  // The ends are outside and the line passes through; a block without a corner in the contact lies on the middle of the
  // top.
  CHECK_THAT(says("capsule: [0.05, 3]", "position: [0, 0, 0]"),
             Contains("surface on 'ground' and capsule on 'b' press"));
  CHECK_THAT(says("cylinder: [0.05, 3]", "position: [0, 0, 0]"),
             Contains("surface on 'ground' and cylinder on 'b' press"));
  CHECK_THAT(says("box: [0.1, 0.1, 0.1]", "position: [0, 0, 0]"), Contains("surface on 'ground' and box on 'b' press"));
  CHECK_THAT(says("box: [2, 2, 0.4]", "position: [0, 0, 0]"), Contains("surface on 'ground' and box on 'b' press"));
  CHECK_THAT(says("box: [0.1, 0.1, 0.1]", "position: [0, 0, 0.56]"), Contains("went on"));
}

TEST_CASE("what falls on a floor of triangles in adaptive steps meets it as it meets a plane") {
  // In free flight the length of steps is not limited: some would end deep below the floor, where there is no contact
  // force.
  const TemporaryFolder folder;
  write_triangles(folder.path() + "/floor.stl", floor_of_triangles(2, 6));
  for (const char* shape : {"cylinder: [0.1, 0.3]", "box: [0.2, 0.2, 0.3]", "capsule: [0.1, 0.1]"}) {
    CAPTURE(shape);
    const auto height = [&](const std::string& ground) {
      double z = 0;
      run_contact(contact_model({{"b", "position: [0.02, 0.01, 0.2]", 10, {0.1, 0.1, 0.05}}},
                                fmt::format("  it: {{type: contact, shapes: [{{node: ground, {}}}, {{node: b, {}}}], "
                                            "stiffness: 1e7, damping: 0.5}}\n",
                                            ground, shape),
                                "[0, 0, -9.81]"),
                  {0.01, 0.25, 1e-6}, [&](const Session& session, const Motion&) { z = session.node("b").x.z(); });
      return z;
    };
    CHECK(height("surface: " + folder.path() + "/floor.stl") == Approx(height("plane: [0, 0, 1]")).margin(1e-4));
  }
}
