// Hinges and ball joints with play against closed forms: rest, rebound, friction, and the joint without play as the gap
// goes to zero.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace {

/// A motion with adaptive steps.
void fly(const std::string& text, double tolerance, double end, const std::function<void(Session&, Motion&)>& look,
         double largest = 0) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = end;
  options.stepping.size = 1e-4 * end;
  options.stepping.tolerance = tolerance;
  if (largest > 0) options.stepping.largest = largest;
  Motion motion = session.dynamics(options);
  while (motion.step()) look(session, motion);
}

}  // namespace

TEST_CASE("a journal rests where its contacts bear its weight") {
  // The journal has two ends, each with half of 3 kg * 10 m/s^2 = k p^1.5.
  const auto rest = [](const std::string& more) {
    const MechanismFile file = read_mechanism_text(
        R"yaml(
gravity: [0, -10, 0]
nodes:
  journal: {position: [0, -1.02e-3, 0], fixed: [z, rx, ry, rz]}
elements:
  journal: {type: point_mass, node: journal, mass: 3}
joints:
  it: {type: clearance_hinge, nodes: [ground, journal], at: [[0, 0, 0], [0, 0, 0]], axis: [0, 0, 1], second_axis: [1, 0, 0], radial_gap: 1e-3, )yaml" +
            more + "}\n",
        "model.yaml");
    Session session(file.model);
    compute_statics(session);
    return session.read("joints/it/coordinate")[1];
  };
  CHECK(-rest("length: 0.1, contact: {stiffness: 1e8}") - 1e-3 == Approx(std::pow(15 / 1e8, 2. / 3)).epsilon(1e-8));
  CHECK(-rest("contact: {stiffness: 1e6, exponent: 1}") - 1e-3 == Approx(3e-5).epsilon(1e-8));
  // The cylinders are of steel: pi/4 E* l p, E* = 210e9/(2 (1 - 0.09)).
  CHECK(-rest("length: 0.1, contact: {young: 210e9, poisson: 0.3}") - 1e-3 ==
        Approx(30 / (M_PI / 4 * 210e9 / (2 * 0.91) * 0.1)).epsilon(1e-4));  // relative to a position of 1 mm
}

TEST_CASE("a ball in a socket is pressed in as Hertz has it") {
  const MechanismFile file = read_mechanism_text(
      R"yaml(
gravity: [0, 0, -10]
nodes:
  ball: {position: [0, 0, -1.01e-3], fixed: [rx, ry, rz]}
elements:
  ball: {type: point_mass, node: ball, mass: 30}
joints:
  it: {type: clearance_spherical, nodes: [ground, ball], at: [[0, 0, 0], [0, 0, 0]], radial_gap: 1e-3, radius: 0.02, contact: {young: [210e9, 110e9], poisson: [0.3, 0.34]}}
)yaml",
      "model.yaml");
  Session session(file.model);
  compute_statics(session);
  const double E = 1 / ((1 - 0.09) / 210e9 + (1 - 0.34 * 0.34) / 110e9), R = 0.02 * 0.021 / 0.001;
  CHECK(-session.read("joints/it/coordinate")[2] - 1e-3 ==
        Approx(std::pow(300 / (4. / 3 * E * std::sqrt(R)), 2. / 3)).epsilon(1e-6));
}

TEST_CASE("a ball rebounds in its socket by its restitution at any speed") {
  for (const double speed : {0.01, 0.1, 1.0, 10.0})
    for (const double restitution : {0.3, 0.8}) {
      double after = 0;
      int touches = 0;
      const std::string text = fmt::format(R"yaml(
nodes:
  ball: {{velocity: [{}, 0, 0], fixed: [rx, ry, rz]}}
elements:
  ball: {{type: point_mass, node: ball, mass: 0.5}}
joints:
  it: {{type: clearance_spherical, nodes: [ground, ball], radial_gap: 0.01, contact: {{stiffness: 1e8, restitution: {}}}}}
)yaml",
                                           speed, restitution);
      // The journal flies 0.01 m to the other side, and is half way back after this time. Surfaces penetrate by 1e-6 to
      // 4e-4 m, and the error of steps should be small compared with that: 1e-10 of the size of 1 m.
      fly(text, 1e-11, 0.01 / speed * (1 + 0.5 / restitution) + 3e-3 / std::pow(speed, 0.2),
          [&](Session& session, Motion&) {
            after = -session.node("ball").v[0];
            touches += session.read("joints/it/normal_force")[0] > 0 ? 1 : 0;
          });
      CAPTURE(speed, restitution, touches);
      CHECK(touches > 5);
      CHECK(after / speed == Approx(restitution).epsilon(5e-4));
    }
}

TEST_CASE("a shaft that turns in its bush climbs by the angle of friction") {
  // Its weight W acts down; normal force and friction mu N balance it at an angle atan(mu) from below, on the side from
  // which the lowest point of the shaft moves away: N = W cos(phi). The shaft turns about +z: its lowest point slides
  // along +x, friction pushes it along -x.
  const double mu = 0.2, phi = std::atan(mu);
  const std::string text = R"yaml(
gravity: [0, -10, 0]
nodes:
  shaft: {position: [0, -1.01e-3, 0], fixed: [z, rx, ry], motion: {rz: "60*t"}}
elements:
  shaft: {type: point_mass, node: shaft, mass: 3}
  air: {type: node_force, nodes: [ground, shaft], axes: inertial, force: ["-200*shaft.velocity.x", "-200*shaft.velocity.y", 0]}
joints:
  it:
    {type: clearance_hinge, nodes: [ground, shaft], at: [[0, 0, 0], [0, 0, 0]], axis: [0, 0, 1], second_axis: [1, 0, 0],
     radial_gap: 1e-3, length: 0.1, radius: 0.02, contact: {stiffness: 1e7, damping: 1}, friction: {coefficient: 0.2, velocity: 0.001}}
)yaml";
  double x = 0, y = 0, torque = 0, N = 0;
  fly(text, 1e-7, 2, [&](Session& session, Motion&) {
    const std::vector<double> q = session.read("joints/it/coordinate"), force = session.read("joints/it/normal_force");
    x = q[0];
    y = q[1];
    N = force[0] + force[1];
    torque = session.read("joints/it/reaction")[5];
  });
  CHECK(std::atan2(-x, -y) == Approx(phi).epsilon(1e-4));
  CHECK(N == Approx(30 * std::cos(phi)).epsilon(1e-5));
  CHECK(torque == Approx(-mu * N * (0.02 + std::hypot(x, y) - 1e-3)).epsilon(1e-2));
  CHECK(torque == Approx(-mu * N * 0.02).epsilon(1e-4));  // at the journal's radius
}

TEST_CASE("collars bear a thrust, and rub at their radius") {
  // A force of 50 N presses the shaft up against the collar at +z, which turns with it: 50 N = k p^2, torque mu 50 N r.
  const std::string text = R"yaml(
nodes:
  shaft: {position: [0, 0, 2.01e-3], fixed: [x, y, rx, ry], motion: {rz: "-60*t"}}
elements:
  shaft: {type: point_mass, node: shaft, mass: 3}
  air: {type: node_force, nodes: [ground, shaft], axes: inertial, force: [0, 0, "-200*shaft.velocity.z"]}
loads:
  thrust: {node: shaft, force: [0, 0, 50]}
joints:
  it:
    {type: clearance_hinge, nodes: [ground, shaft], at: [[0, 0, 0], [0, 0, 0]], axis: [0, 0, 1], radial_gap: 1e-3, axial_gap: 2e-3,
     radius: 0.02, contact: {stiffness: 1e7}, axial_contact: {stiffness: 2e8, exponent: 2}, friction: {coefficient: 0.2, velocity: 0.001}}
)yaml";
  fly(text, 1e-8, 1, [&](Session& session, Motion&) {
    if (session.time() < 1 - 1e-12) return;
    const double z = session.read("joints/it/coordinate")[2];
    CHECK(z - 2e-3 == Approx(std::sqrt(50 / 2e8)).epsilon(1e-6));
    CHECK(session.read("joints/it/reaction")[5] == Approx(0.2 * 50 * 0.02).epsilon(1e-6));
    CHECK(session.read("joints/it/reaction")[2] == Approx(-50).epsilon(1e-6));
  });
}

TEST_CASE("without play journal, ball and collars have their stiffness in the middle, once") {
  // 3 kg; springs of n = 1: w^2 = k/m along each direction that has a contact.
  struct Kind {
    std::string keys;
    int held;  ///< directions with a contact
  };
  for (const Kind& kind :
       {Kind{"clearance_hinge, axis: [0, 0, 1], radial_gap: 0, axial_gap: 0, axial_contact: "
             "{stiffness: 1200, exponent: 1}",
             3},
        Kind{"clearance_hinge, axis: [0, 0, 1], radial_gap: 0", 2}, Kind{"clearance_spherical, radial_gap: 0", 3}}) {
    CAPTURE(kind.keys);
    const MechanismFile file = read_mechanism_text(
        "nodes: {journal: {fixed: [rx, ry, rz]}}\nelements: {journal: {type: point_mass, node: journal, mass: 3}}\n"
        "joints: {it: {nodes: [ground, journal], contact: {stiffness: 1200, exponent: 1}, type: " +
            kind.keys + "}}\n",
        "model.yaml");
    Session session(file.model);
    int held = 0;
    for (const Mode& mode : compute_modes(session, {}).found.modes) {
      if (std::abs(mode.s) < 1e-3) continue;
      CHECK(std::abs(mode.s) == Approx(20).epsilon(1e-6));
      ++held;
    }
    CHECK(held == kind.held);
  }
}

TEST_CASE("a journal tilts as far as its ends have play") {
  // A couple of 2 N m about x presses the ends of the journal, 0.1 m apart, against opposite sides of the bore: 20 N
  // each.
  const std::string text = R"yaml(
nodes:
  shaft: {rotation_vector: [0.0401, 0, 0], fixed: [x, y, z]}
elements:
  shaft: {type: rigid_body, node: shaft, mass: 3, inertia: [1, 1, 1]}
loads:
  couple: {node: shaft, moment: [2, 0, 0]}
joints:
  it:
    {type: clearance_hinge, nodes: [ground, shaft], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]], radial_gap: 2e-3, length: 0.1,
     contact: {stiffness: 1e7}, stiffness: {angle: 1}}
)yaml";
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  const double tilt = std::acos(session.node("shaft").R(2, 2));
  const double force = session.read("joints/it/normal_force")[0];
  CHECK(force == Approx(20 / std::cos(tilt)).epsilon(1e-8));  // arms of 0.05 m cos(tilt)
  CHECK(session.read("joints/it/normal_force")[1] == Approx(force).epsilon(1e-8));
  CHECK(0.05 * std::sin(tilt) - 2e-3 == Approx(std::pow(force / 1e7, 2. / 3)).epsilon(1e-6));
}

TEST_CASE("the energy balance closes for a journal that tumbles in its bush with friction and restitution") {
  const std::string text = R"yaml(
gravity: [0, -10, 0]
nodes:
  journal: {velocity: [0.3, 0.1, 0.2], angular_velocity: [0.5, -0.3, 20]}
elements:
  journal: {type: rigid_body, node: journal, mass: 2, inertia: [2e-3, 2e-3, 1e-3]}
joints:
  it:
    {type: clearance_hinge, nodes: [ground, journal], axis: [0, 0, 1], radial_gap: 2e-3, axial_gap: 4e-3, length: 0.1, radius: 0.02,
     contact: {stiffness: 1e8, restitution: 0.7}, friction: {coefficient: 0.2, velocity: 0.05}}
)yaml";
  double dissipated = 0, missing = 0;
  std::vector<double> least{1, 1, 1, 1};
  fly(text, 1e-7, 0.3, [&](Session& session, Motion& motion) {
    CHECK(motion.energy().dissipation >= dissipated - 1e-15);
    dissipated = motion.energy().dissipation;
    missing = motion.balance();
    const std::vector<double> p = session.read("joints/it/penetration");
    for (std::size_t k = 0; k < 4; ++k) least[k] = std::min(least[k], -p[k]);
  });
  CHECK(dissipated > 0.1);
  CHECK(std::abs(missing) < 2e-3 * dissipated);
  // No body passes through another: k p^2.5/2.5 is less than the energy at the start and of a fall over two gaps.
  const double energy = 0.5 * 2 * 0.14 + 0.5 * 1e-3 * 400 + 0.5 * 2e-3 * 0.34 + 20 * 4e-3;
  for (const double gap : least) CHECK(gap > -std::pow(2.5 * energy / 1e8, 0.4));
}

TEST_CASE("a slider-crank with play moves like the one without as the gap goes to zero") {
  const auto positions = [](const std::string& pin, std::vector<double>& x) {
    const std::string text = R"yaml(
nodes:
  crank: {position: [0.1, 0, 0]}
  rod: {position: [0.25, 0, 0]}
  slider: {position: [0.4, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [1e-2, 1e-2, 1e-2]}
  rod: {type: rigid_body, node: rod, mass: 0.5, inertia: [1e-3, 4e-3, 4e-3]}
  slider: {type: rigid_body, node: slider, mass: 0.8, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [crank, rod], position: [0.1, 0, 0], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
  pin: {nodes: [rod, slider], position: [0.4, 0, 0], axis: [0, 0, 1], )yaml" +
                             pin + R"yaml(}
drives:
  motor: {joint: main, angle: "20*t*step(t, 0, 0.1)"}
)yaml";
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 0.8;
    options.stepping.size = 1e-4;
    Motion motion = session.dynamics(options);
    for (int k = 1; k <= 80; ++k) {
      motion.advance_to(0.01 * k);
      x.push_back(session.node("slider").x[0]);
    }
  };
  std::vector<double> ideal;
  positions("type: hinge", ideal);
  double before = 0;
  for (const double gap : {1e-3, 5e-4, 2.5e-4}) {
    std::vector<double> x;
    positions(fmt::format(
                  "type: clearance_hinge, radial_gap: {}, length: 0.02, contact: {{stiffness: 1e9, damping: 2}}", gap),
              x);
    double most = 0;
    for (std::size_t k = 0; k < x.size(); ++k) most = std::max(most, std::abs(x[k] - ideal[k]));
    CAPTURE(gap, most);
    // Forces of about 100 N cause penetrations of 1e-5 m.
    CHECK(most < 1.15 * gap + 2e-5);
    CHECK(most > 0.8 * gap);
    if (before > 0) CHECK(most / before == Approx(0.5).epsilon(0.15));
    before = most;
  }
}
