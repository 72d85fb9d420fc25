// Bodies at rest on others: penetration and forces in closed form, boxes that tumble to rest on a face.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Static equilibrium of a model.
void rest(const std::string& text, const std::function<void(const Session&)>& look) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  look(session);
}

}  // namespace

TEST_CASE("a ball rests where gravity is balanced: depth (m g/k)^(1/n)") {
  for (const double n : {1.0, 1.5, 2.2})
    rest(contact_model({{"ball", "position: [0, 0, 0.099], fixed: [x, y, rx, ry, rz]", 3}},
                       fmt::format("  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: ball, "
                                   "sphere: 0.1}}], stiffness: 1e5, exponent: {}, restitution: 0.5}}\n",
                                   n),
                       "[0, 0, -9.81]"),
         [&](const Session& session) {
           CAPTURE(n);
           CHECK_THAT(-session.read("contacts/it/gap")[0], Catch::WithinRel(std::pow(3 * g / 1e5, 1 / n), 1e-9));
           CHECK_THAT(session.read("contacts/it/force")[2], Catch::WithinRel(3 * g, 1e-9));
           CHECK(session.read("contacts/it/state")[0] == 1);
         });
}

TEST_CASE("a wedge between two planes presses on each with its share of the weight") {
  // A cube stands on an edge in a groove of planes at 30 and 60 degrees: the forces are m g cos(30) and m g cos(60).
  rest(contact_model({{"cube",
                       "position: [-0.03656, 0, 0.13649], rotation_vector: [0, 'pi/6', 0], fixed: [y, rx, rz]",
                       5,
                       {0.03, 0.03, 0.03}}},
                     R"yaml(
  low: {type: contact, shapes: [{node: ground, plane: ['sin(pi/6)', 0, 'cos(pi/6)']}, {node: cube, box: [0.2, 0.2, 0.2]}], stiffness: 1e7}
  steep: {type: contact, shapes: [{node: ground, plane: ['-sin(pi/3)', 0, 'cos(pi/3)']}, {node: cube, box: [0.2, 0.2, 0.2]}], stiffness: 1e7}
)yaml",
                     "[0, 0, -9.81]"),
       [](const Session& session) {
         const auto norm = [&](const char* name) {
           const std::vector<double> f = session.read(fmt::format("contacts/{}/force", name));
           return std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
         };
         // The corners penetrate by 1e-4 of the edge; the cube turns by less.
         CHECK_THAT(norm("low"), Catch::WithinRel(5 * g * std::cos(M_PI / 6), 1e-4));
         CHECK_THAT(norm("steep"), Catch::WithinRel(5 * g * std::cos(M_PI / 3), 1e-4));
       });
}

TEST_CASE("a box that tumbles on a plane loses energy at every impact, and comes to rest on a face") {
  const std::string text = contact_model(
      {{"box",
        "position: [0, 0, 0.5], rotation_vector: [0.5, 0.3, 0.2], velocity: [0.5, 0, 0], angular_velocity: [2, -3, 1]",
        1,
        {0.0025, 0.0025, 0.0025}}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: box, box: [0.12, 0.12, 0.12]}], "
      "stiffness: "
      "1e6, restitution: 0.4, friction: {coefficient: 0.4, velocity: 0.005}}\n",
      "[0, 0, -9.81]");
  double energy = 1e300, grown = 0, missing = 0, speed = 0, spin = 0, height = 0, upright = 0;
  run_contact(text, {2e-4, 3}, [&](const Session& session, const Motion& motion) {
    const Energy& e = motion.energy();
    const double now = e.kinetic + e.elastic + e.gravity;
    grown = std::max(grown, now - energy);
    energy = std::min(energy, now);
    missing = std::max(missing, std::abs(motion.balance()));
    const NodeState& box = session.node("box");
    speed = box.v.norm();
    spin = box.Omega.norm();
    height = box.x.z();
    upright = box.R.row(2).cwiseAbs().maxCoeff();
  });
  CHECK(grown < 1e-3);  // relative to 4.9 J, the error of the steps in an impact
  CHECK(missing < 2e-2);
  CHECK(speed < 1e-3);
  CHECK(spin < 1e-2);
  CHECK_THAT(upright, Catch::WithinAbs(1, 1e-8));
  // Four corners bear it.
  CHECK_THAT(height, Catch::WithinAbs(0.06 - std::pow(g / 4 / 1e6, 1 / 1.5), 1e-6));
}

TEST_CASE("capsules and cylinders lie, cylinders stand, boxes stack") {
  struct Case {
    const char *shape, *node;
    double height;
  };
  const double weight = 2 * g;
  const auto depth = [&](double points) { return std::pow(weight / points / 1e6, 1 / 1.5); };
  for (const Case& each : {Case{"capsule: [0.1, 0.4]", "rotation_vector: [0, 1.55, 0]", 0.1 - depth(2)},
                           Case{"cylinder: [0.1, 0.4]", "rotation_vector: [0, 1.55, 0]", 0.1 - depth(2)},
                           Case{"cylinder: [0.1, 0.1]", "rotation_vector: [0.02, 0.01, 0]", 0.05 - depth(1)},
                           Case{"box: [0.2, 0.3, 0.1]", "rotation_vector: [0.02, 0.01, 0]", 0.05 - depth(4)}}) {
    CAPTURE(each.shape);
    double height = 0;
    run_contact(contact_model({{"body", fmt::format("position: [0, 0, 0.12], {}", each.node), 2, {0.02, 0.02, 0.02}}},
                              fmt::format("  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: "
                                          "body, {}}}], stiffness: 1e6, damping: 3, friction: {{coefficient: 0.5}}}}\n",
                                          each.shape),
                              "[0, 0, -9.81]"),
                {5e-4, 4}, [&](const Session& session, const Motion&) { height = session.node("body").x.z(); });
    CHECK_THAT(height, Catch::WithinAbs(each.height, 2e-6));
  }
}

TEST_CASE("a box rests on a box that is turned, a capsule across a box") {
  const std::string text = contact_model(
      {{"low", "position: [0, 0, 0.05]", 2, {0.02, 0.02, 0.02}},
       {"high", "position: [0.01, 0.02, 0.15], rotation_vector: [0, 0, 0.4]", 1, {0.01, 0.01, 0.01}},
       {"roll", "position: [0, 0, 0.24], rotation_vector: [0, 'pi/2', 0]", 1, {0.01, 0.01, 0.01}}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: low, box: [0.3, 0.3, 0.1]}, {node: "
      "high, "
      "box: [0.2, 0.2, 0.1]}, {node: roll, capsule: [0.04, 0.3]}], stiffness: 1e6, damping: 3, friction: {coefficient: "
      "0.5, velocity: 1e-3}}\n",
      "[0, 0, -9.81]");
  double z = 0, roll = 0, moved = 0;
  run_contact(text, {5e-4, 1}, [&](const Session& session, const Motion&) {
    z = session.node("high").x.z();
    roll = session.node("roll").x.z();
    moved = (session.node("high").x - Vector3(0.01, 0.02, session.node("high").x.z())).norm();
  });
  // Corners of a box rest on faces, crossings of edges carry the capsule; eccentric loads tilt them by about 1e-4 rad.
  const auto depth = [](double weight, double points) { return std::pow(weight * g / points / 1e6, 1 / 1.5); };
  const double expected = 0.15 - depth(4, 4) - depth(2, 4);
  CHECK_THAT(z, Catch::WithinAbs(expected, 2e-5));
  CHECK_THAT(roll, Catch::WithinAbs(expected + 0.09 - depth(1, 2), 2e-5));
  CHECK(moved < 1e-3);
}

TEST_CASE("what is drawn into each other is told") {
  const MechanismFile file = read_mechanism_text(
      contact_model({{"ball", "position: [0, 0, 0.09]"}},
                    "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], "
                    "stiffness: 1e6}\n"),
      "model.yaml");
  REQUIRE(file.warnings.size() == 1);
  CHECK_THAT(file.warnings[0], Catch::Contains("sphere on 'ball' are drawn into each other by 0.01 m"));
}

TEST_CASE("the end of a beam rests on a stop: shapes on nodes of beams") {
  // A cantilever of 1 m under 50 N at its end, with a ball 1 mm above a plane: 3 EI/L^3 w + N = 50, N = k p^1.5, w = 1
  // mm + p. Deflections are a thousandth of the length.
  constexpr double EI = 5000, k = 1e6;
  double p = 0;
  for (double low = 0, high = 0.01, j = 0; j < 100; ++j) {
    p = 0.5 * (low + high);
    (3 * EI * (1e-3 + p) + k * std::pow(p, 1.5) < 50 ? low : high) = p;
  }
  REQUIRE(p > 1e-5);
  rest(R"yaml(
nodes:
  root: {fixed: true}
  tip: {position: [1, 0, 0]}
elements:
  beam: {type: beam, nodes: [root, tip], section: {EA: 1e8, GAy: 1e8, GAz: 1e8, GJ: 5000, EIy: 5000, EIz: 5000}, elements: 4}
joints:
  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1], at: [0, 0, -0.051]}, {node: tip, sphere: 0.05}], stiffness: 1e6}
loads:
  pull: {node: tip, force: [0, 0, -50]}
)yaml",
       [&](const Session& session) {
         CHECK_THAT(session.read("contacts/it/force")[2], Catch::WithinRel(k * std::pow(p, 1.5), 1e-3));
         CHECK_THAT(-session.node("tip").x.z(), Catch::WithinRel(1e-3 + p, 1e-4));
       });
}

TEST_CASE("the rounding of a cylinder's rim lifts it where it stands on the rim alone") {
  // Axis at an angle a to the normal: the spheroid at the end of the core, its middle H = 0.01 (R - r) within the end,
  // reaches sqrt((R - r)^2 sin^2 a + H^2 cos^2 a) below its middle (disc_distance.hpp), the skin r below that.
  constexpr double R = 0.2, h = 0.3, e = 0.01;
  for (const double r : {0.01, 0.05, 0.15})
    for (const double a : {0.0, 0.3, 0.8, M_PI / 2}) {
      CAPTURE(r, a);
      const double H = e * (R - r);
      const double below = (h - r - H) * std::cos(a) + std::hypot((R - r) * std::sin(a), H * std::cos(a)) + r;
      const std::string text = contact_model(
          {{"body", fmt::format("position: [0, 0, 1], rotation_vector: [0, {:.17g}, 0]", a)}},
          fmt::format("  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: body, cylinder: "
                      "[{}, {}], rounding: {}}}], stiffness: 1}}\n",
                      R, 2 * h, r));
      double gap = 0;
      run_contact(text, {1e-3, 1e-3},
                  [&](const Session& session, const Motion&) { gap = session.read("contacts/it/gap")[0]; });
      CHECK_THAT(gap, Catch::WithinAbs(1 - below, 1e-12));
    }
}

TEST_CASE("what a contact tells formulas is what it records") {
  const std::string text =
      contact_model({{"ball", "position: [0, 0, 0.099], fixed: [rx, ry, rz]", 3}},
                    "  it: {type: contact, between: [[{node: ground, plane: [0, 0.6, 0.8], at: [0, 0, 0.05]}, "
                    "{node: ground, plane: [0, 0, 1]}], [{node: ball, sphere: 0.1}]], stiffness: 1e5}\n"
                    "measures: {gap: it.gap, x: it.force.x, y: it.force.y, z: it.force.z, all: it.force, "
                    "pairs: it.touching}\n",
                    "[0, 0, -9.81]");
  run_contact(text, {1e-3, 0.05}, [&](const Session& session, const Motion&) {
    const auto measure = [&](const char* name) { return session.read(fmt::format("measures/{}", name))[0]; };
    const std::vector<double> force = session.read("contacts/it/force");  // planes, ball
    CHECK(measure("gap") == session.read("contacts/it/gap")[0]);
    CHECK(measure("pairs") == session.read("contacts/it/state")[0]);
    CHECK_THAT(measure("x"), Catch::WithinAbs(force[6], 1e-12));
    CHECK_THAT(measure("y"), Catch::WithinAbs(force[7], 1e-12));
    CHECK_THAT(measure("z"), Catch::WithinAbs(force[8], 1e-12));
    const auto size = [&](std::size_t k) { return Vector3(force[k], force[k + 1], force[k + 2]).norm(); };
    CHECK_THAT(measure("all"), Catch::WithinRel(size(0) + size(3), 1e-12));
  });
  // In a group, the shapes are first and second in different pairs, so that a sum over first shapes has no meaning.
  const auto read = [](const char* measure) {
    return fmt::format(
        "nodes: {{a: {{}}, b: {{position: [1, 0, 0]}}, c: {{position: [2, 0, 0]}}}}\njoints: {{it: {{type: contact, "
        "shapes: [{{node: a, sphere: 0.1}}, {{node: b, sphere: 0.1}}, {{node: c, sphere: 0.1}}], stiffness: 1}}}}\n"
        "measures: {{m: it.{}}}\n",
        measure);
  };
  CHECK_NOTHROW(read_mechanism_text(read("force"), "model.yaml"));
  CHECK_THROWS_WITH(read_mechanism_text(read("force.x"), "model.yaml"), Catch::Contains("'it' has no 'force.x'"));
}

TEST_CASE("what nothing holds is let go until a contact holds it, and statics say which contact was open") {
  const std::vector<Body> ball = {{"ball", "position: [0, 0, 0.13], fixed: [x, y, rx, ry, rz]", 2}};
  const std::string plane =
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e5}\n";
  const std::string socket =
      "  it: {type: clearance_spherical, nodes: [ground, ball], position: [0, 0, 0], radial_gap: 0.03, radius: 0.01, "
      "contact: {stiffness: 1e5}}\n";
  const auto says_open = [](const std::string& text) {
    CHECK_THAT(text, Catch::Contains("joint 'it' is open, its ") && Catch::Contains("0.03 m apart"));
  };
  const auto height = [&](const std::string& joint) {
    const MechanismFile file = read_mechanism_text(contact_model(ball, joint, "[0, 0, -9.81]"), "model.yaml");
    Session session(file.model);
    says_open(compute_statics(session).log.fell);
    return session.node("ball").x[2];
  };
  // The displacement is (m g/k)^(2/3) into the plane, the distance down to the plane, and that from the middle of the
  // socket to the end of its gap.
  const double depth = std::pow(2 * g / 1e5, 2.0 / 3);
  CHECK_THAT(height(plane), Catch::WithinAbs(0.1 - depth, 1e-12));
  CHECK_THAT(height(socket), Catch::WithinAbs(0.13 - 0.03 - depth, 1e-12));
  // No shape is above the plane.
  const std::string message =
      message_of<std::runtime_error>([&] { rest(contact_model(ball, plane, "[0, 0, 9.81]"), [](const Session&) {}); });
  says_open(message);
  CHECK_THAT(message, Catch::Contains("holds nothing"));
}

TEST_CASE("in a group a static analysis names the shapes that touch nothing") {
  // One ball stands on a ball of ground, the other falls past it.
  const std::string text =
      contact_model({{"low", "position: [0, 0, 0.099], fixed: [x, y, rx, ry, rz]"},
                     {"high", "position: [3, 0, 0.3], fixed: [x, y, rx, ry, rz]"}},
                    "  it: {type: contact, shapes: [{node: ground, sphere: 1, at: [0, 0, -1]}, {node: low, sphere: "
                    "0.1}, {node: high, sphere: 0.1}], stiffness: 1e5}\n",
                    "[0, 0, -9.81]");
  CHECK_THROWS_WITH(rest(text, [](const Session&) {}), Catch::Contains("joint 'it' is open at sphere on 'high'"));
}
