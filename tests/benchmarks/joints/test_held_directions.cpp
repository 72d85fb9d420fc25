// Nodes held along their own axes, or against one rotation alone: closed forms, and joints that hold the same.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using bielle::InputError;
using bielle::mechanism::Matrix3;
using bielle::mechanism::Session;
using bielle::mechanism::Vector3;
using bielle::test::message_of;
using bielle::test::move_to;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_held_directions {
namespace {

std::vector<double> support(const Session& session, const std::string& node) {
  return session.read("supports/" + node + "/reaction");
}

/// Returns a body that tumbles about the ground's origin under a moment. @param hold  keys of its node @param joints
/// section
std::string tumbling(const std::string& hold, const std::string& rates, const std::string& joints = "") {
  return fmt::format(R"yaml(
nodes: {{body: {{{}, angular_velocity: {}}}}}
elements: {{body: {{type: rigid_body, node: body, mass: 1, inertia: [1, 1.4, 2]}}}}
loads: {{push: {{node: body, moment: ["0.7*cos(t)", 0.4, "-0.5*t"]}}}}
{})yaml",
                     hold, rates, joints);
}

struct Held {
  std::string direction, axis, second_axis, rates;
};
// Bryant angles about x, y, z are in this order: the two free ones are the axes of a cross.
const std::vector<Held> one_rotation = {{"rx", "[0, 1, 0]", "[0, 0, 1]", "[0, 2, 3]"},
                                        {"ry", "[1, 0, 0]", "[0, 0, 1]", "[2, 0, 3]"},
                                        {"rz", "[1, 0, 0]", "[0, 1, 0]", "[2, 3, 0]"}};

}  // namespace

TEST_CASE("one held rotation moves as a universal joint with the two others as its cross, over many turns") {
  for (const Held& held : one_rotation) {
    CAPTURE(held.direction);
    Session alone = session_of(tumbling("fixed: [x, y, z, " + held.direction + "]", held.rates));
    Session joined = session_of(tumbling(
        "position: [0, 0, 0]", held.rates,
        fmt::format("joints: {{cross: {{type: universal, nodes: [ground, body], position: [0, 0, 0], axis: {}, "
                    "second_axis: {}}}}}\n",
                    held.axis, held.second_axis)));
    auto motion = alone.dynamics(steps_of(6, 5e-3));
    auto other = joined.dynamics(steps_of(6, 5e-3));
    double largest = 0;
    while (motion.step() && other.step()) {
      CHECK((alone.node("body").R - joined.node("body").R).norm() < 1e-7);
      const std::vector<double> reaction = support(alone, "body"),
                                by_joint = joined.read("joints/cross/reaction_inertial");
      const double size = 1 + std::abs(by_joint[3]) + std::abs(by_joint[4]) + std::abs(by_joint[5]);
      for (std::size_t k = 3; k < 6; ++k) CHECK(std::abs(reaction[k] - by_joint[k]) < 1e-5 * size);
      largest = std::max(largest, alone.node("body").Omega.norm());
      CHECK_THAT(alone.balance(), WithinAbs(0, 1e-2));
    }
    CHECK(largest > 1);
  }
}

TEST_CASE("a held rotation bears the moment about it, and no other") {
  for (const std::size_t k : {0U, 1U, 2U}) {
    const std::string name(1, "xyz"[k]);
    Vector3 moment = Vector3::Zero();
    moment[static_cast<Eigen::Index>(k)] = 5;
    Session session = session_of(fmt::format(R"yaml(
nodes: {{body: {{rotation_vector: [0.3, -0.8, 0.5], fixed: [r{}]}}}}
elements: {{body: {{type: rigid_body, node: body, mass: 1, inertia: [1, 1, 1]}}}}
loads: {{push: {{node: body, moment: [{}, {}, {}], force: [2, 0, 0]}}}}
)yaml",
                                             name, moment[0], moment[1], moment[2]));
    session.dynamics(steps_of(0.5, 0.01)).finish();
    const std::vector<double> reaction = support(session, "body");
    for (std::size_t j = 0; j < 6; ++j) CHECK_THAT(reaction[j], WithinAbs(j == 3 + k ? -5 : 0, 1e-10));
    CHECK(session.node("body").Omega.norm() < 1e-10);
    CHECK_THAT(session.node("body").v.x(), WithinRel(1.0, 1e-9));
  }
}

TEST_CASE("a block slides down a slope along its own axes, which bears its weight across") {
  const double slope = 0.4, g = 9.81, m = 3;
  for (const std::string rotations : {", rx, ry, rz", ""}) {
    move_to(fmt::format(R"yaml(
gravity: [0, 0, -{}]
nodes: {{block: {{rotation_vector: [0, {}, 0], velocity: [{}, 0, {}], fixed: [y, z{}], fixed_axes: own}}}}
elements: {{block: {{type: rigid_body, node: block, mass: {}, inertia: [1, 1, 1]}}}}
)yaml",
                        g, slope, 2 * std::cos(slope), -2 * std::sin(slope), rotations, m),
            0.05, 1, [&](const Session& session) {
              const Vector3 way = Vector3(std::cos(slope), 0, -std::sin(slope)) * (2 + 0.5 * g * std::sin(slope));
              CHECK((session.node("block").x - way).norm() < 1e-9);
              const std::vector<double> reaction = support(session, "block");
              const Vector3 normal = Vector3(std::sin(slope), 0, std::cos(slope)) * (m * g * std::cos(slope));
              CHECK((Vector3(reaction[0], reaction[1], reaction[2]) - normal).norm() < 1e-8);
            });
  }
}

TEST_CASE("a part that is turned or mirrored takes the own axes of its nodes along") {
  const std::string part = R"yaml(
gravity: [0, 0, -9.81]
definitions:
  slider:
    nodes: {block: {rotation_vector: [0, 0.1, 0], fixed: [y, z, rx, ry, rz], fixed_axes: AXES}}
    elements: {block: {type: point_mass, node: block, mass: 3}}
parts: {p: {part: slider, PLACE}}
)yaml";
  const auto text = [&](const std::string& axes, const std::string& place) {
    std::string result = part;
    result.replace(result.find("AXES"), 4, axes);
    return result.replace(result.find("PLACE"), 5, place);
  };
  struct Place {
    std::string keys;
    double slope;  ///< angle by which the block's x axis points downwards
  };
  for (const Place& place : {Place{"rotation_vector: [0, 0.4, 0]", 0.5}, Place{"mirror: x", 0.1}})
    move_to(text("own", place.keys), 0.05, 1, [&](const Session& session) {
      const double side = place.keys == "mirror: x" ? -1 : 1, way = 0.5 * 9.81 * std::sin(place.slope);
      const Vector3 expected = way * Vector3(side * std::cos(place.slope), 0, -std::sin(place.slope));
      CHECK((session.node("p.block").x - expected).norm() < 1e-9);
    });
  CHECK_THAT(message_of<InputError>([&] { session_of(text("inertial", "rotation_vector: [0, 0.4, 0]")); }),
             Contains("nodes.p.block.fixed") && Contains("fixed_axes: own"));
}

TEST_CASE("two rotations held along own axes leave the hinge about the third") {
  const std::string orientation = "rotation_vector: [0.5, -0.9, 0.3]";
  const Vector3 z = bielle::mechanism::exp_so3(Vector3(0.5, -0.9, 0.3)).col(2);
  Session alone = session_of(tumbling(orientation + ", fixed: [x, y, z, rx, ry], fixed_axes: own", "[0, 0, 4]"));
  Session joined = session_of(tumbling(
      orientation, "[0, 0, 4]",
      fmt::format("joints: {{axle: {{type: hinge, nodes: [ground, body], position: [0, 0, 0], axis: [{:.17g}, {:.17g}, "
                  "{:.17g}]}}}}\n",
                  z.x(), z.y(), z.z())));
  auto motion = alone.dynamics(steps_of(4, 5e-3));
  auto other = joined.dynamics(steps_of(4, 5e-3));
  while (motion.step() && other.step()) {
    CHECK((alone.node("body").R - joined.node("body").R).norm() < 1e-8);
    const std::vector<double> reaction = support(alone, "body"),
                              by_joint = joined.read("joints/axle/reaction_inertial");
    for (std::size_t k = 0; k < 6; ++k) CHECK(std::abs(reaction[k] - by_joint[k]) < 1e-6 * 20);
  }
}

TEST_CASE("axes that are inertial ones as drawn hold the same either way") {
  for (const std::string axes : {"inertial", "own"}) {
    Session session = session_of(tumbling("fixed: [x, y, z, rx, ry], fixed_axes: " + axes, "[0, 0, 4]"));
    session.dynamics(steps_of(1, 0.01)).finish();
    // 2 wdot = -t/2
    CHECK_THAT(session.node("body").Omega.z(), WithinRel(4 - 0.125, 1e-6));
    CHECK_THAT(support(session, "body")[3], WithinRel(-0.7 * std::cos(1), 1e-6));
  }
}

TEST_CASE("at rest a roller on an inclined plane bears the force across it") {
  // A spring of 100 N/m along the slope; the load of 10 N is inclined by 0.3 rad to it.
  const double slope = 0.3;
  const Vector3 along(std::cos(slope), std::sin(slope), 0), across(-std::sin(slope), std::cos(slope), 0);
  Session session = session_of(fmt::format(R"yaml(
nodes:
  roller: {{rotation_vector: [0, 0, {}], fixed: [y, z, rx, ry, rz], fixed_axes: own}}
  anchor: {{position: [{:.17g}, {:.17g}, 0], fixed: true}}
elements:
  roller: {{type: point_mass, node: roller, mass: 1}}
  spring: {{type: spring_damper, nodes: [anchor, roller], stiffness: 100, length: 1}}
loads: {{push: {{node: roller, force: [10, 0, 0]}}}}
)yaml",
                                           slope, -along.x(), -along.y()));
  compute_statics(session);
  CHECK((session.node("roller").x - 0.1 * std::cos(slope) * along).norm() < 1e-9);
  const std::vector<double> reaction = support(session, "roller");
  CHECK((Vector3(reaction[0], reaction[1], reaction[2]) - 10 * std::sin(slope) * across).norm() < 1e-8);
}

/// Returns a pendulum of a rod without inertia about itself and a mass that does not turn. @param upper  the joint at
/// the top
std::string rod(const std::string& upper, double about_itself, const std::string& start = "[0, 1, 0.5]") {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{rod: {{position: [0.5, 0, 0]}}, mass: {{position: [1, 0, 0], fixed: [rx, ry, rz], velocity: {}}}}}
elements:
  rod: {{type: rigid_body, node: rod, mass: 1, inertia: [{}, 0.08, 0.08]}}
  mass: {{type: point_mass, node: mass, mass: 2}}
joints:
  a: {{{}, nodes: [ground, rod], position: [0, 0, 0]}}
  b: {{type: spherical, nodes: [rod, mass], position: [1, 0, 0]}}
)yaml",
                     start, about_itself, upper);
}

TEST_CASE("a universal joint that holds the spin of a rod leaves its motion as it is") {
  Session held = session_of(rod("type: universal, axis: [0, 1, 0], second_axis: [0, 0, 1]", 0));
  Session spinning = session_of(rod("type: spherical", 1e-3, "[0, 1, 0.5]"));
  auto motion = held.dynamics(steps_of(1, 2e-3));
  auto other = spinning.dynamics(steps_of(1, 2e-3));
  double gap = 0;
  while (motion.step() && other.step()) gap = std::max(gap, (held.node("mass").x - spinning.node("mass").x).norm());
  CHECK(gap < 1e-4);  // errors of the steps differ by the terms of the spin
  CHECK((held.node("mass").x - Vector3(1, 0, 0)).norm() > 0.5);
}

TEST_CASE("a node that two held rotations leave one axis is on the wrong branch if this axis is turned over") {
  using bielle::mechanism::exp_so3;
  const Session session = session_of(tumbling("fixed: [x, y, z, rx, ry], fixed_axes: own", "[0, 0, 2]"));
  const auto body = static_cast<std::size_t>(*session.model().find_node("body"));
  const auto wrong_after = [&](const Vector3& turn) {
    bielle::mechanism::State state = session.state();
    state.nodes[body].R = exp_so3(turn) * state.nodes[body].R;
    return session.system().wrong_branch(state, {});
  };
  CHECK(wrong_after(Vector3::Zero()).empty());
  CHECK(wrong_after(Vector3(0, 0, M_PI)).empty());
  CHECK_THAT(wrong_after(Vector3(M_PI, 0, 0)), Contains("'body': the node is turned over"));
  CHECK_THAT(wrong_after(Vector3(0, M_PI, 0)), Contains("'body': the node is turned over"));
}

TEST_CASE("wrong holds are told with their keys") {
  const auto said = [](const std::string& keys, const std::string& more = "") {
    return message_of<InputError>([&] { session_of(tumbling(keys, "[0, 0, 0]", more)); });
  };
  CHECK_THAT(said("fixed: true, fixed_axes: own"), Contains("fixed_axes") && Contains("list of `fixed` directions"));
  CHECK_THAT(said("fixed_axes: own"), Contains("list of `fixed` directions"));
  CHECK_THAT(said("fixed: [x], fixed_axes: owm"), Contains("own"));
  CHECK_THAT(said("fixed: [x], fixed_axes: own, motion: {y: t}"),
             Contains("motion") && Contains("along inertial axes"));
  CHECK_THAT(said("rotation_vector: [0, 0, 0.3], velocity: [1, 0, 0], fixed: [x], fixed_axes: own"),
             Contains("velocity") && Contains("held along x of its own axes"));
  CHECK_THAT(message_of<InputError>([&] { session_of(tumbling("fixed: [rx]", "[1, 0, 0]")); }),
             Contains("angular_velocity") && Contains("turning about x"));
  CHECK_THAT(message_of<InputError>([&] {
               session_of(
                   "nodes: {body: {}, tip: {fixed: [rz]}}\n"
                   "elements: {body: {type: rigid_body, node: body, mass: 1, inertia: [1, 1, 1], also: [tip]}}\n");
             }),
             Contains("nodes.tip.fixed") && Contains("carried rigidly by 'body'"));
}

}  // namespace test_held_directions
