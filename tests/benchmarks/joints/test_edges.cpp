// Difficult cases of joints: turns at the start, directions that turn without their nodes, tangential contact.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::mechanism::Session;
using bielle::test::move_to;
using Catch::Contains;

namespace test_edges {
namespace {

void run(const std::string& text, double end = 0.01) {
  move_to(text, 0.01, end, [](const Session&) {});
}

}  // namespace

TEST_CASE(
    "points that run fast on a circle keep their energy where steps are long: rods, links and curves as hinges do") {
  // The wheel turns by 0.6 rad per step at 30 m/s: the scheme alone dissipates about 2 % of 450 J in 1 s; without
  // correction of velocities links gained more than twice their energy.
  const bielle::test::TemporaryFolder folder;
  const std::string path = folder.path() + "/circle.csv";
  std::ofstream out(path);
  for (int k = 0; k < 400; ++k)
    out << fmt::format("{:.17g}, {:.17g}, 0\n", std::cos(2 * M_PI * k / 400), std::sin(2 * M_PI * k / 400));
  out.close();
  for (const std::string& joint :
       {std::string("type: distance"), std::string("type: revolute_spherical, axis: [0, 0, 1]"),
        "type: point_on_curve, closed: true, curve: \"" + path + "\""}) {
    const std::string text =
        "nodes: {p: {position: [1, 0, 0], velocity: [0, 30, 0], fixed: [z, rx, ry, rz]}}\n"
        "elements: {m: {type: point_mass, node: p, mass: 1}}\n"
        "joints: {j: {nodes: [ground, p], " +
        joint + "}}\n";
    CAPTURE(joint);
    move_to(text, 0.02, 1, [](const Session& session) {
      CHECK(session.energy().kinetic == Approx(450).epsilon(0.05));
      CHECK(session.node("p").x.norm() == Approx(1).epsilon(1e-5));
    });
  }
}

TEST_CASE("a screw starts many turns away by its displacement, with a start value or a drive") {
  const std::string body =
      "nodes: {n: {}}\nelements: {b: {type: rigid_body, node: n, mass: 1, inertia: [1, 1, 1]}}\n"
      "joints: {s: {type: screw, nodes: [ground, n], axis: [0, 0, 1], pitch: 0.01";
  for (const std::string& rest : {std::string(", start: {displacement: 0.1}}}\n"),
                                  std::string("}}\ndrives: {d: {joint: s, displacement: \"0.1 + 0.01*t\"}}\n")})
    move_to(body + rest, 0.01, 0.01, [](const Session& session) {
      CHECK(session.read("joints/s/coordinate")[1] ==
            Approx(2 * M_PI * session.read("joints/s/coordinate")[0] / 0.01).epsilon(1e-9));
      CHECK(session.read("joints/s/coordinate")[0] == Approx(0.1).epsilon(2e-3));
    });
}

TEST_CASE("teeth and belts whose wheels start beyond half a turn say that they do not know the turns") {
  const std::string text = R"yaml(
nodes: {w1: {}, w2: {position: [0.07, 0, 0]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1], start: 4.0}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1], start: -1.6}
  it: )yaml";
  CHECK_THROWS_WITH(run(text + "{type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05]}\n"),
                    Contains("joint 'h1' starts 4 rad from there"));
  CHECK_THROWS_WITH(run(text + "{type: belt, nodes: [w1, w2], axis: [0, 0, 1], radii: [0.02, 0.03], EA: 1e4}\n"),
                    Contains("joint 'h1' starts 4 rad from there"));
  run(text + "{type: gear, joints: [h1, h2], ratio: -0.4}\n");  // its constraint involves the joints' coordinates
}

TEST_CASE("a crown wheel is pushed away by its pinion, whichever is named first") {
  // Axis of the crown z, of the pinion in the xz plane: cone angles 90 degrees and the pinion's own.
  const double tilt = 0.5;  // sin of the pinion's cone angle
  const std::string axis = fmt::format("[{:.17g}, 0, {:.17g}]", std::cos(std::asin(tilt)), tilt);
  for (const bool crown_first : {true, false}) {
    const std::string text = fmt::format(R"yaml(
nodes: {{crown: {{}}, pinion: {{}}}}
elements:
  b1: {{type: rigid_body, node: crown, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  b2: {{type: rigid_body, node: pinion, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  h1: {{type: hinge, nodes: [ground, crown], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, pinion], axis: {}}}
  mesh: {{type: gear_mesh, {}, position: [0.04, 0, 0]}}
drives: {{motor: {{joint: h1, torque: 1}}}}
)yaml",
                                         axis,
                                         crown_first ? "nodes: [crown, pinion], axes: [[0, 0, 1], " + axis + "]"
                                                     : "nodes: [pinion, crown], axes: [" + axis + ", [0, 0, 1]]");
    CAPTURE(crown_first);
    // The pinion's axis passes above P, on the side of +z: the crown is pushed towards -z, and its bearing reacts.
    move_to(text, 0.01, 0.02,
            [](const Session& session) { CHECK(session.read("joints/h1/reaction_inertial")[2] > 1); });
  }
}

TEST_CASE("a rope that just touches a pulley has no arc") {
  const std::string text = R"yaml(
nodes: {a: {position: [0, 1, 0], fixed: true}, p: {position: [1.7, 1.39, 0], fixed: true}, b: {position: [2.8, 1, 0], fixed: true}}
joints: {rope: {type: cable, nodes: [a, p, b], radii: [0, 0.39, 0], axis: [0, 0, 1], EA: 1e4}}
)yaml";
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  session.assemble();
  CHECK(session.read("joints/rope/length")[0] == Approx(2.8).epsilon(1e-9));
}

TEST_CASE("statics begin where teeth and ropes only touch") {
  // The teeth transmit 1 N m on wheel 1 by r = 0.02 and 0.05 to a spring of 100 N m/rad.
  const std::string teeth = R"yaml(
nodes: {w1: {}, w2: {position: [0.07, 0, 0]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1], stiffness: 100}
  it: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e6}
drives: {motor: {joint: h1, torque: 1}}
)yaml";
  const bielle::mechanism::MechanismFile of_teeth = bielle::mechanism::read_mechanism_text(teeth, "model.yaml");
  Session loaded(of_teeth.model);
  compute_statics(loaded);
  CHECK(loaded.read("joints/h2/coordinate")[0] == Approx(-2.5 / 100).epsilon(1e-8));
  const std::string rope = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {fixed: true}, m: {position: [0, 0, -2], fixed: [x, y, rx, ry, rz]}}
elements: {mass: {type: point_mass, node: m, mass: 3}}
joints: {rope: {type: cable, nodes: [top, m], radii: [0, 0], EA: 1e4}}
)yaml";
  const bielle::mechanism::MechanismFile of_rope = bielle::mechanism::read_mechanism_text(rope, "model.yaml");
  Session hanging(of_rope.model);
  compute_statics(hanging);
  CHECK(hanging.node("m").x.z() == Approx(-2 - 3 * 9.81 * 2 / 1e4).epsilon(1e-9));
}

TEST_CASE("wheels that coast on elastic teeth without play have no events") {
  const std::string text = R"yaml(
nodes: {w1: {angular_velocity: [0, 0, 100]}, w2: {position: [0.07, 0, 0], angular_velocity: [0, 0, -40]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}
  it: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e6, damping: 100}
)yaml";
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  int events = 0;
  session.on_event([&](const bielle::mechanism::Event&) { ++events; });
  bielle::mechanism::DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.01;
  session.dynamics(options).finish();
  CHECK(events == 0);
  CHECK(session.read("joints/h1/rate")[0] == Approx(100).epsilon(1e-6));
}

TEST_CASE("couplings that share a load report what the summary says, and each half") {
  const std::string text = R"yaml(
nodes: {w1: {}, w2: {position: [0.07, 0, 0]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}
  g1: {type: gear, joints: [h1, h2], ratio: -0.4}
  g2: {type: gear, joints: [h1, h2], ratio: -0.4}
drives: {motor: {joint: h1, torque: 1}}
)yaml";
  move_to(text, 0.01, 0.1, [](const Session& session) {
    const std::vector<double> one = session.read("joints/g1/force"), two = session.read("joints/g2/force");
    CHECK(one[0] == Approx(two[0]).epsilon(1e-8));  // accuracy of solutions to 1e-9
    CHECK(one[0] < -0.01);
  });
}

TEST_CASE("joints that make no sense are refused in words") {
  const std::string body =
      "nodes: {n: {position: [1, 0, 0]}}\n"
      "elements: {b: {type: rigid_body, node: n, mass: 1, inertia: [1, 1, 1]}}\njoints:\n";
  CHECK_THROWS_WITH(run(body + "  rod: {type: distance, nodes: [ground, n], length: \"1 - 9*t\"}\n", 0.15),
                    Contains("the length of joint 'rod'"));
  const bielle::test::TemporaryFolder folder;
  const std::string lift = folder.file("lift.csv", "0, 0\n2, 1\n4, 1\n6, 0\n");
  CHECK_THROWS_WITH(
      run(body + "  h: {type: hinge, nodes: [ground, n], axis: [0, 0, 1]}\n  c: {type: cam, joints: [h, h], lift: \"" +
          lift + "\"}\n"),
      Contains("coupled with itself"));
}

}  // namespace test_edges
