// A machine that is placed, turned and mirrored as a whole moves as it does where it is drawn.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/language/placement.hpp"
#include "mechanism/math/rotation_parameters.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/dynamics/scheme.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace {

/// Sections of a machine whose joints, beams, forces and inertias leave axes to their defaults.
const std::string machine = R"yaml(
    nodes:
      arm: {position: [0.5, 0.1, 0.2], rotation_vector: [0.3, -0.2, 0.5], angular_velocity: [0, 0.3, 0]}
      wrist: {position: [1, 0.2, 0.3], velocity: [0, 0.1, 0]}
      end: {position: [1.5, 0.2, 0.8]}
      side: {at: arm, position: [0.1, 0.2, -0.1], rotation_vector: [0, 0.4, 0]}
      rider: {position: [0, 1, 0.3], rotation_vector: [0.1, 0.2, 0.3], velocity: [0.2, 0, 0.1], angular_velocity: [1, 2, 3]}
      cart: {position: [0.2, -0.5, 0.1]}
    elements:
      arm: {type: rigid_body, node: arm, mass: 2, centre: [0.1, 0.02, 0], inertia: [0.3, 0.4, 0.5, 0.02, -0.03, 0.05], also: [side]}
      rider: {type: rigid_body, node: rider, mass: 1, inertia: [[0.2, 0.01, 0], [0.01, 0.3, 0.02], [0, 0.02, 0.4]]}
      cart: {type: rigid_body, node: cart, solid: {box: [0.1, 0.2, 0.3], mass: 3, rotation_vector: [0.2, 0, 0.1]}}
      bar: {type: beam, nodes: [wrist, end], elements: 2, twist: 0.4, section: {rectangle: [0.05, 0.02], young: 1e9, poisson: 0.3, density: 3000}}
      spring: {type: spring_damper, nodes: [arm, rider], at: [[0, 0.1, 0], [0.1, 0, 0]], stiffness: 300, damping: 2, length: 0.4}
      pull: {type: node_force, nodes: [arm, cart], force: [1, "2*sin(9*t)", 0.5], moment: [0, 0.2, 0.1], at: [0, 0.1, 0], axes: inertial}
      push: {type: node_force, nodes: [arm, rider], force: [0.3, 0.2, "t"], moment: [0.1, 0, 0]}
      anchor: {type: spring_damper, nodes: [ground, cart], at: [[0.4, 0.3, 0.1], [0, 0.1, 0]], stiffness: 200}
      tether: {type: node_force, nodes: [rider, ground], force: [0.5, "2*t", 0.3], at: [0.3, 0.1, 0.2]}
      stay: {type: node_force, nodes: [ground, rider], force: [0.5, "2*t", 0.3], moment: [0.1, 0, "t"]}
    joints:
      shoulder: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0.2, 1, 0.1], stiffness: 5, rest: 0.2}
      elbow: {type: universal, nodes: [arm, wrist], axis: [0, 0, 1], second_axis: [0, 1, 0], stiffness: {angle_1: 20, angle_2: 10}}
      rail: {type: prismatic, nodes: [ground, cart], axis: [1, 0.5, 0], stiffness: 100, rest: 0.05}
      link: {type: distance, nodes: [cart, side]}
      ramp: {type: contact, stiffness: 2e4, shapes: [{node: ground, plane: [0, 0.1, 1], at: [0, 0, 0.17], rotation_vector: [0.1, 0, 0]}, {node: rider, sphere: 0.1}]}
    drives:
      motor: {joint: shoulder, torque: "3*sin(5*t) - 0.1*shoulder.angle"}
    measures:
      reach: {node: rider, relative_to: arm, quantity: position, direction: x, at: [[0.1, 0, 0.2], [0, 0.1, 0]]}
      rise: {node: rider, direction: [0.1, 0.2, 1], at: [[0.1, 0.3, 0.2], [0, 0.1, 0]]}
    loads:
      servo: {node: rider, force: [reach, 0, "2*rise"]}
      wind: {node: rider, force: ["2*t", 1, 0.2], moment: [0.1, 0, "0.3*cos(3*t)"], at: [0.1, 0, 0]}
      thrust: {node: rider, force: [0.1, 0, 1], moment: [0, 0.2, 0], follower: true}
)yaml";

/// @param keys  keys of the placed part
std::string placed(const std::string& keys, const Vector3& gravity) {
  return fmt::format("gravity: [{}, {}, {}]\ndefinitions:\n  machine:{}parts: {{it: {{part: machine{}}}}}\n",
                     gravity[0], gravity[1], gravity[2], machine, keys);
}

State run(const ReadyModel& model) { return bielle::test::integrate(model, Scheme::generalized_alpha(0.8), 0.01, 0.2); }

void check_moves_alike(const Placement& placement) {
  const Vector3 x = placement.frame.x, turn = log_so3(placement.frame.R), gravity(0.5, -1, -9);
  std::string keys = fmt::format(", position: [{}, {}, {}], rotation_vector: [{}, {}, {}]", x[0], x[1], x[2], turn[0],
                                 turn[1], turn[2]);
  if (placement.mirrored >= 0) keys += fmt::format(", mirror: {}", "xyz"[placement.mirrored]);
  const Matrix3 A = placement.matrix(bielle::KeyForm::Geometry::vector, true);
  const ReadyModel drawn(placed("", gravity)), moved(placed(keys, A * gravity));
  const State here = run(drawn), there = run(moved);
  double motion = 0;
  for (const char* name : {"it.arm", "it.wrist", "it.end", "it.rider", "it.cart"}) {
    CAPTURE(name, placement.mirrored);
    const NodeState &a = drawn.node(here, name), &b = moved.node(there, name);
    CHECK((x + A * a.x - b.x).norm() < 1e-8);
    CHECK((A * a.v - b.v).norm() < 1e-7);
    CHECK((placement.orientation(a.R, true) - b.R).norm() < 1e-8);
    motion = std::max(motion, a.v.norm());
  }
  CHECK(motion > 0.3);
}

}  // namespace

TEST_CASE("held directions and motions along the mirror stay in a mirror image, others are refused") {
  const auto mirrored = [](const std::string& node, const char* keys) {
    return "definitions:\n  stand:\n    nodes: {foot: {" + node +
           "}}\n    elements: {m: {type: rigid_body, node: foot, mass: 1, inertia: [1, 1, 1]}}\n"
           "parts: {it: {part: stand, " +
           keys + "}}\n";
  };
  const auto refused = [&](const std::string& node, const char* keys) {
    return bielle::test::message_of<bielle::InputError>([&] { ReadyModel(mirrored(node, keys)); });
  };
  const ReadyModel model(mirrored("fixed: [x, y, rx, ry, rz], motion: {z: t}", "mirror: y"));
  CHECK(model.node(run(model), "it.foot").x[2] == Approx(0.2));
  CHECK(refused("motion: {x: t, ry: t, rx: 0, rz: 0}", "mirror: x").find("nodes.it.foot.motion") != std::string::npos);
  CHECK(refused("fixed: [x, z, rx, rz], motion: {y: t}", "mirror: y").find("motion") != std::string::npos);
  CHECK(refused("fixed: [x]", "rotation_vector: [0, 0, 1]").find("nodes.it.foot.fixed") != std::string::npos);
  CHECK(refused("motion: {z: t}", "rotation_vector: [0, 0, 1]").find("motion") != std::string::npos);
}

TEST_CASE("a machine that is placed elsewhere moves as where it is drawn") {
  check_moves_alike({{Vector3(1, -2, 3), RotationVector::rotation(Vector3(0.4, 1.1, -0.7))}, -1});
  check_moves_alike({{Vector3(0, 0, 0), RotationVector::rotation(Vector3(0, 0, 2 * M_PI / 3))}, -1});
}

TEST_CASE("a machine that is mirrored moves as its mirror image") {
  for (const int axis : {0, 1, 2}) check_moves_alike({{Vector3(0, 0, 0), Matrix3::Identity()}, axis});
  check_moves_alike({{Vector3(1, -2, 3), RotationVector::rotation(Vector3(0.4, 1.1, -0.7))}, 1});
}

TEST_CASE("axes of joints that are not given turn with their part, also where two are equally normal") {
  // In-plane axes of a plane, whose normal is z of the part: the inertial x is as normal to it as y.
  const std::string part = R"yaml(
definitions:
  ice:
    nodes: {puck: {position: [0.2, 0.1, 0], velocity: [0.5, 0.2, 0], angular_velocity: [0, 0, 1]}}
    elements: {puck: {type: rigid_body, node: puck, mass: 1, inertia: [1, 1, 1]}}
    joints: {plane: {type: planar, nodes: [ground, puck], axis: [0, 0, 1]}}
parts: {it: {part: ice)yaml";
  for (const char* turn : {"[0.5, -0.9, 0.7]", "[0.4, 1.1, -0.7]", "[0, 0, 2]", "[3, 0.1, 0.2]"}) {
    CAPTURE(turn);
    Session session(read_mechanism_text(fmt::format("{}, rotation_vector: {}}}}}\n", part, turn), "model.yaml").model);
    const std::vector<double> rates = session.read("joints/it.plane/rate");
    CHECK(rates[0] == Approx(0.5).epsilon(1e-12));
    CHECK(rates[1] == Approx(0.2).epsilon(1e-12));
  }
}

TEST_CASE("the curve of a joint is placed with its part") {
  const std::string part = fmt::format(R"yaml(
definitions:
  ring:
    nodes: {{car: {{position: [7.5, 0, 0], velocity: [0, 1.5, 0], fixed: [rx, ry, rz]}}}}
    elements: {{car: {{type: point_mass, node: car, mass: 1}}}}
    joints: {{track: {{type: point_on_curve, nodes: [ground, car], curve: {}/mechanism/examples/track.csv, closed: true}}}}
)yaml",
                                       BIELLE_SOURCE_DIR);
  const auto at_end = [&](const std::string& keys, const Vector3& gravity) {
    const ReadyModel model(fmt::format("gravity: [{}, {}, {}]\n{}parts: {{it: {{part: ring{}}}}}\n", gravity[0],
                                       gravity[1], gravity[2], part, keys));
    return model.node(run(model), "it.car").x;
  };
  const Vector3 gravity(0.5, -1, -9), x(1, -2, 3), turn(0.4, 1.1, -0.7), drawn = at_end("", gravity);
  const Matrix3 R = RotationVector::rotation(turn);
  const std::string moved = ", position: [1, -2, 3]", turned = ", rotation_vector: [0.4, 1.1, -0.7]";
  CHECK((drawn - Vector3(7.5, 0, 0)).norm() > 0.1);
  CHECK((at_end(moved, gravity) - x - drawn).norm() < 1e-9);
  CHECK((at_end(turned, R * gravity) - R * drawn).norm() < 1e-9);
  CHECK((at_end(moved + turned, R * gravity) - x - R * drawn).norm() < 1e-9);
}

TEST_CASE("the bend of a joint that is drawn bent has the axes of its part") {
  const std::string part = R"yaml(
definitions:
  shafts:
    nodes: {in: {}, out: {}}
    elements:
      in: {type: rigid_body, node: in, mass: 1, inertia: [1, 1, 1]}
      out: {type: rigid_body, node: out, mass: 1, inertia: [1, 1, 1]}
    joints: {bend: {type: constant_velocity, nodes: [in, out], axes: [[0, 0, 1], [0.6, 0, 0.8]]}}
parts: {it: {part: shafts)yaml";
  for (const char* turn : {"[0, 0, 0]", "[0.5, -0.9, 0.7]", "[0, 1.5707963267948966, 0]"}) {
    CAPTURE(turn);
    Session session(read_mechanism_text(fmt::format("{}, rotation_vector: {}}}}}\n", part, turn), "model.yaml").model);
    const std::vector<double> bend = session.read("joints/it.bend/coordinate");
    CHECK(bend[0] == Approx(0).margin(1e-12));  // about y of the part
    CHECK(bend[1] == Approx(std::acos(0.8)).epsilon(1e-12));
  }
}
