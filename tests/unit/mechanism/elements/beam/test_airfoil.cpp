// Aerodynamic forces on beams against closed forms of strip theory.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::session_of;
using bielle::test::steps_of;

namespace test_airfoil {

constexpr double rho = 1.2, chord = 0.3, length = 2, wind = 10;

/// Returns a stiff massless blade along x with its chord along y, hinged at the origin to flap about y, with a hub of
/// 50 kg m^2.
std::string flapping_blade(const std::string& keys) {
  return fmt::format(R"yaml(
nodes:
  root: {{position: [0, 0, 0], angular_velocity: [0, -0.02, 0]}}
  tip: {{position: [2, 0, 0], velocity: [0, 0, 0.04], angular_velocity: [0, -0.02, 0]}}
elements:
  hub: {{type: rigid_body, node: root, mass: 1, inertia: [50, 50, 50]}}
  blade:
    type: beam
    nodes: [root, tip]
    elements: 4
    orientation: [0, 1, 0]
    section: {{EA: 1e9, GAy: 1e9, GAz: 1e9, GJ: 1e8, EIy: 1e8, EIz: 1e8, mass_per_length: 1, Jx: 0.02, Jy: 0.01, Jz: 0.01}}
    airfoil: {{density: 1.2, chord: 0.3, wind: [0, 10, 0], {}}}
joints: {{flap: {{type: hinge, nodes: [ground, root], axis: [0, -1, 0]}}}}
measures: {{speed: flap.angle.rate}}
)yaml",
                     keys);
}

}  // namespace test_airfoil
using namespace test_airfoil;

TEST_CASE("flapping of a flat plate in the wind is damped by rho c V a l^3/6") {
  // cl = 2 pi alpha, alpha = -x w/V: the moment rho c V/2 2 pi l^3/3 w.
  const double damping = rho * chord * wind * 2 * M_PI * std::pow(length, 3) / 6;
  const double inertia = 50 + std::pow(length, 3) / 3 + 0.01 * length;
  Session session = session_of(flapping_blade("lift: \"2*pi*alpha\""));
  Motion motion = session.dynamics(steps_of(1, 0.005));
  motion.finish();
  // The rate of flapping decays as exp(-D t/J); the wind along the chord turns with the blade by cos(angle), about
  // 1e-5.
  CHECK(session.read("measures/speed")[0] == Approx(0.02 * std::exp(-damping / inertia)).epsilon(1e-5));
}

TEST_CASE("a blade at an angle has the lift, drag and moment of its strips, and follows tables of alpha") {
  // A twist of -0.1 rad gives alpha = 0.1. The blade is at rest and held at its root.
  const std::string text = R"yaml(
nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [2, 0, 0]}}
elements:
  blade:
    type: beam
    nodes: [root, tip]
    elements: 8
    orientation: [0, 1, 0]
    section: {EA: 1e9, GAy: 1e11, GAz: 1e11, GJ: 2e4, EIy: 1e7, EIz: 1e7}
    airfoil: {density: 1.2, chord: 0.3, twist: -0.1, wind: [0, 10, 0], lift: "5*alpha", drag: "0.02 + alpha^2", moment: 0.05}
measures: {up: tip.position.z, back: tip.position.y, turn: tip.rotation.x}
)yaml";
  Session session = session_of(text);
  compute_statics(session);
  const double q = 0.5 * rho * chord * wind * wind, lift = q * 0.5, drag = q * (0.02 + 0.01),
               nose_up = q * chord * 0.05, bending = std::pow(length, 4) / (8 * 1e7);
  // The section turns by about nose_up l^2/(2 GJ), which is about 1e-6 of its angle.
  CHECK(session.read("measures/up")[0] == Approx(lift * bending).epsilon(1e-3));
  CHECK(session.read("measures/back")[0] == Approx(drag * bending).epsilon(1e-3));
  CHECK(session.read("measures/turn")[0] == Approx(-nose_up * length * length / (2 * 2e4)).epsilon(1e-3));
}

TEST_CASE("the blade's divergence is that of strip theory") {
  // Torsion with the lift at a quarter chord in front of the axis: GJ theta'' = -q c e a theta, so that
  // q c e a (2 l/pi)^2 = GJ at the divergence; below it the twist of the tip is amplified.
  const double e = 0.075, GJ = 50, slope = 2 * M_PI, q = 0.5 * rho * chord * wind * wind;
  const double lambda = std::sqrt(q * e * slope / GJ), alpha = 0.01;
  const double exact = alpha * (1 / std::cos(lambda * length) - 1);
  const std::string text = R"yaml(
nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [2, 0, 0]}}
elements:
  blade:
    type: beam
    nodes: [root, tip]
    elements: 16
    orientation: [0, 1, 0]
    section: {EA: 1e9, GAy: 1e9, GAz: 1e9, GJ: 50, EIy: 1e9, EIz: 1e9}
    airfoil: {density: 1.2, chord: 0.3, twist: -0.01, at: [-0.075, 0], wind: [0, 10, 0], lift: "2*pi*alpha"}
measures: {turn: tip.rotation.x}
)yaml";
  Session session = session_of(text);
  compute_statics(session);
  CHECK(-session.read("measures/turn")[0] == Approx(exact).epsilon(5e-3));
}

namespace {

/// Returns a stiff blade along x that pitches about its line with the inertia of its hub. @param quarter  y of its
/// quarter chord
std::string pitching_blade(double quarter, double rate, const std::string& keys) {
  return fmt::format(R"yaml(
nodes:
  root: {{position: [0, 0, 0], angular_velocity: [{0:.17g}, 0, 0]}}
  tip: {{position: [2, 0, 0], angular_velocity: [{0:.17g}, 0, 0]}}
elements:
  hub: {{type: rigid_body, node: root, mass: 1, inertia: [0.05, 1, 1]}}
  blade:
    type: beam
    nodes: [root, tip]
    elements: 2
    orientation: [0, 1, 0]
    section: {{EA: 1e9, GAy: 1e9, GAz: 1e9, GJ: 1e8, EIy: 1e8, EIz: 1e8, mass_per_length: 1, Jx: 0.01, Jy: 0.005, Jz: 0.005}}
    airfoil: {{density: 1.2, chord: 0.3, wind: [0, 10, 0], lift: "2*pi*alpha", at: [{1:.17g}, 0]{2}}}
joints: {{pitch: {{type: hinge, nodes: [ground, root], axis: [1, 0, 0]}}}}
measures: {{beta: pitch.angle, speed: pitch.angle.rate}}
)yaml",
                     rate, quarter, keys);
}

constexpr double pitch_inertia = 0.05 + 0.01 * length;

}  // namespace

TEST_CASE("pitching about the quarter chord is damped by pi/16 rho c^3 V") {
  // The damping of the turn is J w' = -pi/16 rho c^3 V l w (Fung 1955, section 6.10). Lift has no moment about the
  // axis.
  const double D = M_PI / 16 * rho * std::pow(chord, 3) * wind * length;
  Session session = session_of(pitching_blade(0, -1e-3, ""));
  session.dynamics(steps_of(1, 0.005)).finish();
  CHECK(session.read("measures/speed")[0] == Approx(-1e-3 * std::exp(-D / pitch_inertia)).epsilon(2e-5));
  Session undamped = session_of(pitching_blade(0, -1e-3, ", pitch_rate: false"));
  undamped.dynamics(steps_of(1, 0.005)).finish();
  CHECK(undamped.read("measures/speed")[0] == Approx(-1e-3).epsilon(1e-6));
}

TEST_CASE("a plate that pitches about its leading edge has the lift of the angle at the three-quarter chord") {
  // beta nose up, q = pi rho c V^2 l:  J beta'' = -q e (beta + (e + c/2) beta'/V) - D beta', e = c/4 behind the axis.
  const double D = M_PI / 16 * rho * std::pow(chord, 3) * wind * length, e = chord / 4;
  const double q = M_PI * rho * chord * wind * wind * length;
  const double damping = (q * e * (e + chord / 2) / wind + D) / pitch_inertia, w2 = q * e / pitch_inertia;
  const double decay = damping / 2, w = std::sqrt(w2 - decay * decay), t = 0.3;
  REQUIRE(w2 > decay * decay);
  Session session = session_of(pitching_blade(e, -1e-3, ""));  // a nose-up rotation is a negative turn about x
  session.dynamics(steps_of(t, 0.0005)).finish();
  const double beta = 1e-3 * std::exp(-decay * t) * std::sin(w * t) / w;
  CHECK(std::abs(beta) > 1e-5);
  // A section that is softer by a factor of 100 changes the angle by 4e-4, by bending.
  CHECK(-session.read("measures/beta")[0] == Approx(beta).epsilon(1e-4));
}
