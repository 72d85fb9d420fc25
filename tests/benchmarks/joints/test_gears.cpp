// Gears, differentials, racks, and gear meshes with their tooth forces, against closed forms.
//
// Tooth forces: G. Niemann, H. Winter, Maschinenelemente 2 (2003), chapters 21 to 24: with the tangential force F_t at
// the pitch point, radial F_t tan(alpha_n)/cos(beta), axial F_t tan(beta) of helical wheels; bevel wheels of cone angle
// delta: radial F_t tan(alpha) cos(delta), axial F_t tan(alpha) sin(delta).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;

namespace {

/// Returns two wheels side by side on z axes, hinged to the ground; the second is 0.07 m away. Torques of 1 and -1.5 N
/// m.
std::string wheels(const std::string& coupling) {
  return R"yaml(
nodes:
  w1: {position: [0, 0, 0]}
  w2: {position: [0.07, 0, 0]}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-2, 1e-2, 2e-2]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}
)yaml" + coupling +
         "drives:\n  motor: {joint: h1, torque: 1}\n  load: {joint: h2, torque: 1.5}\n";
}

// z = 20 and 50: alpha_1 = (1 - 1.5/2.5)/(J_1 + J_2/2.5^2), tangential force (J_2 alpha_2 + 1.5)/r_2.
constexpr double alpha_1 = (1 - 1.5 / 2.5) / (1e-3 + 2e-2 / 6.25), tangential = (2e-2 * alpha_1 / 2.5 + 1.5) / 0.05;

}  // namespace

TEST_CASE("a gear couples two shafts in the ratio of their teeth") {
  CHECK(alpha_1 == Approx(95.238095238095).epsilon(1e-12));
  for (const char* gear : {"  pair: {type: gear, joints: [h1, h2], teeth: [20, 50]}\n",
                           "  pair: {type: gear, joints: [h1, h2], ratio: -0.4}\n",
                           "  pair: {type: gear, joints: [h2.angle, h1], factors: [5, 2]}\n"})
    move(wheels(gear), 0.01, 0.5, [](const Session& session) {
      const double t = session.time(), theta = session.read("joints/h1/coordinate")[0];
      CHECK(theta == Approx(0.5 * alpha_1 * t * t).epsilon(1e-8));
      CHECK(session.read("joints/h2/coordinate")[0] == Approx(-0.4 * theta).margin(1e-11));
    });
}

TEST_CASE("a gear's results have the torques on its shafts") {
  move_to(wheels("  pair: {type: gear, joints: [h1, h2], teeth: [20, 50]}\n"), 0.01, 0.1, [](const Session& session) {
    const std::vector<double> torque = session.read("joints/pair/force");
    CHECK(torque[0] == Approx(-tangential * 0.02).epsilon(1e-9));
    CHECK(torque[1] == Approx(-tangential * 0.05).epsilon(1e-9));
  });
}

TEST_CASE("a spur gear mesh has the motion of the gear, and its tooth force loads the bearings") {
  move_to(wheels("  mesh: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05]}\n"), 0.01, 0.1,
          [](const Session& session) {
            const double t = session.time();
            CHECK(session.read("joints/h1/coordinate")[0] == Approx(0.5 * alpha_1 * t * t).epsilon(1e-8));
            CHECK(session.read("joints/h2/coordinate")[0] == Approx(-0.2 * alpha_1 * t * t).epsilon(1e-8));
            // Wheel 1 turns forwards: at the pitch point its teeth move along +y and push wheel 2 along +y, outwards
            // along +x. Bearings bear the opposite.
            CHECK(tangential == Approx(45.238095238095).epsilon(1e-12));
            const double radial = tangential * std::tan(M_PI / 9);
            CHECK(session.read("joints/mesh/force")[0] == Approx(48.141375421529).epsilon(1e-9));
            CHECK(session.read("joints/mesh/force")[1] == 0);
            const std::vector<double> f1 = session.read("joints/h1/reaction_inertial"),
                                      f2 = session.read("joints/h2/reaction_inertial");
            CHECK(f1[0] == Approx(radial).epsilon(1e-9));
            CHECK(f1[1] == Approx(tangential).epsilon(1e-9));
            CHECK(f2[0] == Approx(-radial).epsilon(1e-9));
            CHECK(f2[1] == Approx(-tangential).epsilon(1e-9));
          });
}

TEST_CASE("the other flank pushes wheels apart as well") {
  std::string text = wheels("  mesh: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05]}\n");
  text.replace(text.find("torque: 1}"), 10, "torque: -1}");
  text.replace(text.find("torque: 1.5"), 11, "torque: -1.5");
  move_to(text, 0.01, 0.1, [](const Session& session) {
    CHECK(session.read("joints/mesh/force")[0] == 0);
    CHECK(session.read("joints/mesh/force")[1] == Approx(48.141375421529).epsilon(1e-9));
    CHECK(session.read("joints/h1/reaction_inertial")[0] == Approx(tangential * std::tan(M_PI / 9)).epsilon(1e-9));
    CHECK(session.read("joints/h1/reaction_inertial")[1] == Approx(-tangential).epsilon(1e-9));
  });
}

TEST_CASE("helical teeth push along the axes and tilt the wheels") {
  const double beta = 0.35;
  move_to(wheels(fmt::format("  mesh: {{type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], "
                             "helix_angle: {}}}\n",
                             beta)),
          0.01, 0.1, [&](const Session& session) {
            // Right-handed teeth that move forwards push their partner along t = cos(beta) y - sin(beta) z.
            const double axial = tangential * std::tan(beta), radial = tangential * std::tan(M_PI / 9) / std::cos(beta);
            const std::vector<double> f1 = session.read("joints/h1/reaction_inertial"),
                                      f2 = session.read("joints/h2/reaction_inertial");
            CHECK(f1[0] == Approx(radial).epsilon(1e-9));
            CHECK(f1[1] == Approx(tangential).epsilon(1e-9));
            CHECK(f1[2] == Approx(-axial).epsilon(1e-9));
            CHECK(f2[2] == Approx(axial).epsilon(1e-9));
            // The axial force acts at the pitch point, 0.02 m and 0.05 m away from the axes.
            CHECK(f1[4] == Approx(0.02 * axial).epsilon(1e-9));
            CHECK(f2[4] == Approx(0.05 * axial).epsilon(1e-9));
          });
}

TEST_CASE("a pinion in a ring turns in the ring's sense") {
  // Pinion of 0.02 m in a ring of 0.09 m about (0.07, 0, 0).
  move_to(wheels("  mesh: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.09], internal: true}\n"),
          0.01, 0.1, [](const Session& session) {
            const double theta = session.read("joints/h1/coordinate")[0];
            CHECK(session.read("joints/h2/coordinate")[0] == Approx(theta * 2 / 9).epsilon(1e-9));
            // The teeth meet at (-0.02, 0, 0); they push the ring outwards, along -x, and the pinion along +x.
            const double force = session.read("joints/mesh/force")[0] + session.read("joints/mesh/force")[1];
            CHECK(force > 1);
            CHECK(session.read("joints/h1/reaction_inertial")[0] == Approx(-force * std::sin(M_PI / 9)).epsilon(1e-9));
            CHECK(session.read("joints/h2/reaction_inertial")[0] == Approx(force * std::sin(M_PI / 9)).epsilon(1e-9));
          });
}

TEST_CASE("bevel wheels have the ratio of their cones, and radial and axial forces") {
  // Axes z and x meet in the origin; P = (0.03, 0, 0.04): r_1 = 0.03 about z, r_2 = 0.04 about x.
  const double delta_1 = std::atan2(0.03, 0.04), alpha = 0.4;
  const std::string text = fmt::format(R"yaml(
nodes:
  w1: {{}}
  w2: {{}}
elements:
  b1: {{type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  b2: {{type: rigid_body, node: w2, mass: 1, inertia: [2e-3, 1e-3, 1e-3]}}
joints:
  h1: {{type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, w2], axis: [1, 0, 0]}}
  mesh: {{type: gear_mesh, nodes: [w1, w2], axes: [[0, 0, 1], [1, 0, 0]], position: [0.03, 0, 0.04], pressure_angle: {}}}
drives:
  motor: {{joint: h1, torque: 1}}
)yaml",
                                       alpha);
  move_to(text, 0.01, 0.1, [&](const Session& session) {
    // omega_1 e_z x P = 0.03 omega_1 e_y, omega_2 e_x x P = -0.04 omega_2 e_y.
    const double theta = session.read("joints/h1/coordinate")[0];
    CHECK(session.read("joints/h2/coordinate")[0] == Approx(-0.75 * theta).epsilon(1e-10));
    const double F = 2e-3 * 0.75 * (1 / (1e-3 + 2e-3 * 0.75 * 0.75)) / 0.04;  // J_2 alpha_2/r_2
    const std::vector<double> f1 = session.read("joints/h1/reaction_inertial");
    // The teeth of wheel 1 push wheel 2 along +y, and away from its cone.
    CHECK(f1[1] == Approx(F).epsilon(1e-8));
    CHECK(f1[0] == Approx(F * std::tan(alpha) * std::cos(delta_1)).epsilon(1e-8));
    CHECK(f1[2] == Approx(-F * std::tan(alpha) * std::sin(delta_1)).epsilon(1e-8));
  });
}

TEST_CASE("a worm turns its wheel by its lead") {
  // The worm turns about x at the origin, with radius 0.02 and lead angle 0.2: helix angle pi/2 - 0.2. The wheel turns
  // about z, with radius 0.08, at (0, 0.1, 0). One turn of the worm moves its thread by 2 pi 0.02 tan(0.2).
  const double lead = 0.2;
  const std::string text = fmt::format(R"yaml(
nodes:
  worm: {{}}
  wheel: {{position: [0, 0.1, 0]}}
elements:
  b1: {{type: rigid_body, node: worm, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  b2: {{type: rigid_body, node: wheel, mass: 1, inertia: [1e-2, 1e-2, 1e-2]}}
joints:
  h1: {{type: hinge, nodes: [ground, worm], axis: [1, 0, 0]}}
  h2: {{type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}
  mesh: {{type: gear_mesh, nodes: [worm, wheel], axes: [[1, 0, 0], [0, 0, 1]], position: [0, 0.02, 0], helix_angle: {:.17g}}}
drives:
  motor: {{joint: h1, torque: 1}}
)yaml",
                                       M_PI / 2 - lead);
  move_to(text, 0.01, 0.5, [&](const Session& session) {
    // A right-handed worm that turns about +x draws its nut, here the wheel's rim at (0, 0.02, 0), along -x: that is a
    // turn of the wheel about -z (rim velocity = omega x (0, -0.08, 0) = 0.08 omega e_x).
    const double turned = session.read("joints/h1/coordinate")[0];
    CHECK(turned > 10);
    CHECK(session.read("joints/h2/coordinate")[0] == Approx(-turned * 0.02 * std::tan(lead) / 0.08).epsilon(1e-9));
  });
}

TEST_CASE("a planetary set has the rates of Willis, by gears and by meshes on a moving carrier") {
  // Sun 0.02, planet 0.03, ring 0.08 m fixed to the ground: carrier rate = sun rate * 20/(20 + 80).
  const std::string text = R"yaml(
nodes:
  sun: {}
  carrier: {}
  planet: {position: [0.05, 0, 0]}
elements:
  b1: {type: rigid_body, node: sun, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: planet, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b3: {type: rigid_body, node: carrier, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  h1: {type: hinge, nodes: [ground, sun], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [carrier, planet], axis: [0, 0, 1]}
  h3: {type: hinge, nodes: [ground, carrier], axis: [0, 0, 1]}
)yaml";
  const std::string drive = "drives: {motor: {joint: h1, angle: 30*t}}\n";
  const auto check = [](const Session& session) {
    const double t = session.time();
    CHECK(session.read("joints/h3/coordinate")[0] == Approx(6 * t).epsilon(1e-9));
    CHECK(session.read("joints/h2/coordinate")[0] == Approx(-16 * t).epsilon(1e-9));  // (30 - 6) * 20/30, backwards
  };
  // The ratios are those of the sun relative to the carrier and the planet, and of the ring relative to the carrier and
  // the planet.
  move(text +
           "  outer: {type: gear, joints: [h1, h3, h2], factors: [2, -2, 3]}\n"
           "  inner: {type: gear, joints: [h3, h2], factors: [8, 3]}\n" +
           drive,
       0.01, 0.5, check);
  // Both meshes with teeth are on the carrier; the ring is the ground, represented on the carrier by a node of its own.
  move(
      text +
          "  outer: {type: gear_mesh, nodes: [sun, planet], carrier: carrier, axes: [0, 0, 1], radii: [0.02, 0.03]}\n"
          "  inner: {type: gear_mesh, nodes: [ground, planet], carrier: carrier, axes: [0, 0, 1], radii: [0.08, 0.03], "
          "internal: true}\n" +
          drive,
      0.01, 0.5, check);
}

TEST_CASE("a differential shares the rate of its input and doubles no torque") {
  const std::string text = R"yaml(
nodes: {a: {}, b: {position: [0, 1, 0]}, c: {position: [0, -1, 0]}}
elements:
  b1: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}
  b2: {type: rigid_body, node: b, mass: 1, inertia: [2, 2, 2]}
  b3: {type: rigid_body, node: c, mass: 1, inertia: [5, 5, 5]}
joints:
  in: {type: hinge, nodes: [ground, a], axis: [1, 0, 0]}
  left: {type: hinge, nodes: [ground, b], axis: [0, 1, 0]}
  right: {type: hinge, nodes: [ground, c], axis: [0, 1, 0]}
  diff: {type: differential, joints: [in, left, right], ratio: 3}
drives: {motor: {joint: in, torque: 4}}
)yaml";
  // in = 3 (left + right)/2; equal torques T on both outputs: T = 2 a_l = 5 a_r; input 4 - 2 T/3 = a_in.
  const double T = 4 / (1.5 * (0.5 + 0.2) + 2.0 / 3);
  move_to(text, 0.01, 1, [&](const Session& session) {
    CHECK(session.read("joints/left/coordinate")[0] == Approx(T / 4).epsilon(1e-9));
    CHECK(session.read("joints/right/coordinate")[0] == Approx(T / 10).epsilon(1e-9));
    const std::vector<double> torque = session.read("joints/diff/force");
    CHECK(torque[1] == Approx(T).epsilon(1e-9));
    CHECK(torque[2] == Approx(T).epsilon(1e-9));
    CHECK(torque[0] == Approx(-2 * T / 3).epsilon(1e-9));
  });
}

TEST_CASE("a pinion drives its rack") {
  const std::string text = R"yaml(
nodes: {pinion: {}, rack: {position: [0, -0.1, 0]}}
elements:
  b1: {type: rigid_body, node: pinion, mass: 1, inertia: [0.02, 0.02, 0.02]}
  b2: {type: rigid_body, node: rack, mass: 3, inertia: [1, 1, 1]}
joints:
  axle: {type: hinge, nodes: [ground, pinion], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, rack], axis: [1, 0, 0]}
  teeth: {type: rack_and_pinion, joints: [axle, guide], radius: 0.1}
drives: {motor: {joint: axle, torque: 2}}
)yaml";
  const double alpha = 2 / (0.02 + 3 * 0.01);
  move_to(text, 0.01, 1, [&](const Session& session) {
    CHECK(session.read("joints/guide/coordinate")[0] == Approx(0.05 * alpha).epsilon(1e-9));
    CHECK(session.read("joints/teeth/force")[1] == Approx(3 * 0.1 * alpha).epsilon(1e-9));
  });
}

TEST_CASE("elastic teeth yield by their force, and free play is crossed in free flight") {
  // Wheel 2 is held; at rest the teeth of wheel 1 are compressed by F_n/k along their normal, cos(alpha) r theta.
  const std::string text = R"yaml(
nodes: {w1: {}, w2: {position: [0.07, 0, 0], fixed: true}}
elements: {b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  mesh: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e6, backlash: 2e-4, damping: 2000}
drives: {motor: {joint: h1, torque: 1}}
)yaml";
  const double slope = 0.02 * std::cos(M_PI / 9), play = 1e-4 / slope;
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<bielle::mechanism::Event> events;
  session.on_event([&](const bielle::mechanism::Event& event) { events.push_back(event); });
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.2;
  options.stepping.size = 1e-4;
  session.dynamics(options).finish();
  REQUIRE(!events.empty());
  CHECK(events[0].time == Approx(std::sqrt(2 * play * 1e-3)).epsilon(1e-8));  // theta = t^2/(2 J)
  // The damper has brought the wheel to rest: F_n = 1/slope.
  CHECK(session.read("joints/h1/coordinate")[0] == Approx(play + 1 / (slope * slope * 1e6)).epsilon(1e-6));
  CHECK(session.read("joints/mesh/force")[0] == Approx(1 / slope).epsilon(1e-5));
}
