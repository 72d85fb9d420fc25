// The output of `--check`: each entry in the user's terms, counts, and warnings.
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/io/describe_model.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

using Catch::Contains;
using namespace bielle;
using namespace bielle::mechanism;

namespace {

std::string described(const std::string& text) { return describe_model(read_mechanism_text(text, "model.yaml")); }

const std::string section =
    "section: {EA: 1e5, GAy: 6e4, GAz: 5e4, GJ: 40, EIy: 30, EIz: 20, mass_per_length: 2, Jx: 1, Jy: 1, Jz: 1}";

}  // namespace

TEST_CASE("elements are described by what the user gave") {
  const std::string text = described(R"yaml(
nodes:
  a: {position: [1, 0, 0]}
  b: {position: [2, 0, 0]}
  c: {position: [3, 0, 0]}
elements:
  body: {type: rigid_body, node: a, mass: 2, centre: [0.5, 0, 0], inertia: [1, 2, 2.5]}
  tip: {type: point_mass, node: c, mass: 3}
  arm: {type: beam, nodes: [a, b], elements: 3, damping: 0.01, )yaml" +
                                     section +
                                     R"yaml(, distributed: {force: [0, 0, "-9.81*t"], at: [0.1, 0]}}
  stay: {type: beam, nodes: [b, c], elements: 1, )yaml" +
                                     section + R"yaml(}
  strut: {type: spring_damper, nodes: [ground, c], stiffness: 100, damping: 5, length: 2.5}
  pusher: {type: spring_damper, nodes: [ground, b], force: "3*e + v"}
)yaml");
  CHECK_THAT(text, Contains("  elements     6 (beam 2, point_mass 1, rigid_body 1, spring_damper 2)\n"));
  CHECK_THAT(text,
             Contains("  element 'body' (rigid_body): mass 2 kg on node 'a', centre (0.5, 0, 0) m, inertia about it "
                      "xx 1, yy 2, zz 2.5, xy 0, xz 0, yz 0 kg m^2\n"));
  CHECK_THAT(text, Contains("  element 'tip' (point_mass): mass 3 kg on node 'c', centre (0, 0, 0) m\n"));
  CHECK_THAT(
      text,
      Contains("  element 'arm' (beam): length 1 m, mass 2 kg, 3 elements, damping 0.01 s\n"
               "    section in the middle of each element: EA 100000, GAy 60000, GAz 50000 N, GJ 40, EIy 30, "
               "EIz 20 N m^2\n"
               "    load per length: force (0, 0, -9.81*t) N/m at y 0.1 m, z 0 m of the section, fixed in space\n"));
  CHECK_THAT(text, Contains("  element 'stay' (beam): length 1 m, mass 2 kg, 1 element\n"
                            "    section in the middle of the element: EA"));
  CHECK_THAT(text, Contains("  element 'strut' (spring_damper): between nodes 'ground' and 'c', stiffness 100 N/m, "
                            "damping 5 N s/m, free length 2.5 m, assembled at 3 m\n"));
  CHECK_THAT(text, Contains("force 3*e + v [N], free length 2 m"));
}

TEST_CASE("a tapered beam shows the sections of its ends") {
  const std::string text = described(
      "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\n"
      "elements: {arm: {type: beam, nodes: [a, b], elements: 4, section: [{rectangle: [0.2, 0.1], young: 1e6, shear: "
      "4e5, density: 1000}, {rectangle: [0.1, 0.1], young: 1e6, shear: 4e5, density: 1000}]}}\n");
  CHECK_THAT(text, Contains("    section in the middle of the first element: EA "));
  CHECK_THAT(text, Contains("    section in the middle of the last element: EA "));
  CHECK_THAT(text, !Contains("each element"));
}

TEST_CASE("joints show their frames and what acts in them, drives and loads their laws") {
  const std::string text = described(R"yaml(
parameters: {speed: 2}
nodes:
  a: {position: [1, 0, 0]}
  b: {position: [2, 0, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 2, inertia: [1, 2, 2.5]}
  b: {type: rigid_body, node: b, mass: 2, inertia: [1, 2, 2.5]}
joints:
  main: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], position: [0.5, 0, 0], stiffness: 7, rest: 0.5, preload: 3,
         damping: 0.25, stops: {range: [-1, ~], stiffness: 1e4, damping: 6}, locked: {from: 1, to: 2, release: 50}}
  slide: {type: cylindrical, nodes: [a, b], axis: [1, 0, 0], stiffness: {displacement: "q^3"}}
drives:
  motor: {joint: slide, rate: "speed*t"}
  pull: {joint: slide, force: "5*b.position.x"}
loads:
  push: {node: b, force: [1, "sin(t)", 0], at: [0, 0.1, 0], follower: true}
  twist: {node: a, moment: [0, 0, 4]}
)yaml");
  CHECK_THAT(text, Contains("  joints       2 (cylindrical 1, hinge 1)\n"));
  CHECK_THAT(text, Contains("  in joints    4 (lock 1, spring 2, stops 1)\n"));
  CHECK_THAT(text, Contains("  drives       2\n"));
  CHECK_THAT(text, Contains("  loads        2\n"));
  CHECK_THAT(text,
             Contains("  joint 'main' (hinge): nodes 'ground' and 'a', at (0.5, 0, 0) m, x (1, 0, 0), z (0, 0, 1)\n"
                      "    spring on angle: stiffness 7 N m/rad, damping 0.25 N m s/rad, preload 3 N m, free at "
                      "0.5 rad\n"
                      "    stops on angle: lower end -1 rad, stiffness 10000 N m/rad, damping 6 N m s/rad\n"
                      "    angle locked from 1 s to 2 s, released at 50 N m\n"));
  CHECK_THAT(text, Contains("    spring on displacement: force q^3 [N], free at 0 m\n"));
  CHECK_THAT(text, Contains("  drive 'motor': rate of angle of joint 'slide' is speed*t [rad/s]\n"));
  CHECK_THAT(text, Contains("  drive 'pull': force on displacement of joint 'slide' is 5*b.position.x [N]\n"));
  CHECK_THAT(text,
             Contains("  load 'push': on node 'b', force (1, sin(t), 0) N, at the point (0, 0.1, 0) m in the node's "
                      "axes, turning with the node\n"));
  CHECK_THAT(text, Contains("  load 'twist': on node 'a', moment (0, 0, 4) N m, fixed in space\n"));
}

TEST_CASE("measures, inputs and events say what they are of") {
  const std::string text = described(R"yaml(
nodes:
  a: {position: [1, 0, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 2, inertia: [1, 2, 2.5]}
joints:
  main: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], position: [0, 0, 0]}
drives:
  motor: {joint: main, torque: "command - 2*main.angle.rate"}
measures:
  lag: "2*main.angle"
  height: {node: a, direction: z}
  turning: {node: a, quantity: angular_velocity, direction: x}
inputs: {command: {start: 4, units: N m}}
events:
  landed: {when: height, crosses: -0.1, direction: falling, action: stop}
  passed: {when: main.angle, crosses: 1}
)yaml");
  CHECK_THAT(text, Contains("  measures     4\n"));  // main.angle.rate, made by a formula, is not counted
  CHECK_THAT(text, Contains("  measure 'lag': 2*main.angle [rad]\n"));
  CHECK_THAT(text, Contains("  measure 'height': position of node 'a' along (0, 0, 1) [m]\n"));
  CHECK_THAT(text, Contains("  measure 'turning': angular velocity of node 'a' about (1, 0, 0) [rad/s]\n"));
  CHECK_THAT(text, Contains("  measure 'command': input, starts at 4 [N m]\n"));
  CHECK_THAT(text, Contains("  event 'landed': height falls through -0.1 m, stops the run\n"));
  CHECK_THAT(text, Contains("  event 'passed': main.angle crosses 1 rad, is noted\n"));
  CHECK_THAT(text, !Contains("main.angle.rate'"));
}

TEST_CASE("one thing is told in the singular, and directions without mass by node") {
  const std::string text = described(
      "nodes: {a: {fixed: [x, y, z]}, lonely: {fixed: true}, half: {fixed: [x]}}\n"
      "elements: {a: {type: rigid_body, node: a, mass: 2, inertia: [1, 1, 1]}, half: {type: point_mass, node: half, "
      "mass: "
      "1}}\njoints: {main: {type: spherical, nodes: [ground, half], position: [0, 0, 0]}}\n"
      "loads: {twist: {node: half, moment: [1, 1, 1]}}\n");
  CHECK_THAT(text, Contains("  elements     2 (point_mass 1, rigid_body 1)\n"));
  CHECK_THAT(text, Contains("  joints       1 (spherical)\n"));
  CHECK_THAT(text, Contains("  unused       node 'lonely': no element, joint or load is attached to it\n"));
  CHECK_THAT(text, Contains("  massless     rotation x, rotation y, rotation z of node 'half'\n"));
  const std::string one = described(
      "nodes: {a: {position: [1, 0, 0]}}\nelements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}\n"
      "joints: {main: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}}\n");
  CHECK_THAT(one, Contains("1 degree of freedom after 5 independent constraints\n"));
}

TEST_CASE("points inside superelements say what their compliance is, and residual vectors are no modes") {
  const test::TemporaryFolder folder;
  const test::BeamChain chain = test::straight_beam();
  test::BeamSuperelement reduced = chain.reduced();
  test::add_mesh(chain, 0.03, reduced);
  reduced.body.residual_vectors = 2;
  const MatrixX shapes = MatrixX::Zero(6, reduced.body.size());
  reduced.body.points["all"] = {{0.25, 0, 0}, shapes, {true, true, true, true, true, true}};
  reduced.body.points["some"] = {{0.5, 0, 0}, shapes, {true, false, false, false, false, true}};
  write_superelement(reduced.body, folder / "beam.h5");
  const std::string text = described(
      "points: {p: {element: it, point: all}, q: {element: it, point: some}, r: {element: it, at: [0.25, 0, 0]}}\n"
      "nodes: {root: {fixed: true}}\nelements: {it: {type: superelement, file: " +
      folder.path() + "/beam.h5, nodes: {a: root}}}\n");
  CHECK_THAT(text, Contains("2 modes (") && Contains(" and 2 residual vectors"));
  CHECK_THAT(text, Contains("point 'p' at (0.25, 0, 0) m: its static compliance is exact, by residual vectors"));
  CHECK_THAT(text,
             Contains("point 'q' at (0.5, 0, 0) m: its static compliance is exact in x, rz, by residual vectors"));
  CHECK_THAT(text, Contains("point 'r' at (0.25, 0, 0) m: its compliance is that of interfaces and modes"));
}
