// Loads per length by the motion of the beam and by measures, and polars along a blade, against closed forms.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;
using Catch::Matchers::WithinRel;

namespace test_loads_by_motion {

constexpr double rho = 1.2, chord = 0.3, length = 2;

/// Returns a stiff blade along x with its chord along y, hinged to turn about z, with the hub's inertia of 5 kg m^2.
std::string turning_blade(double rate, const std::string& load, const std::string& more = "") {
  return fmt::format(R"yaml(
nodes:
  root: {{angular_velocity: [0, 0, {0:.17g}]}}
  tip: {{position: [2, 0, 0], velocity: [0, {1:.17g}, 0], angular_velocity: [0, 0, {0:.17g}]}}
elements:
  hub: {{type: rigid_body, node: root, mass: 1, inertia: [5, 5, 5]}}
  blade:
    type: beam
    nodes: [root, tip]
    elements: 4
    damping: 1e-4
    orientation: [0, 1, 0]
    section: {{EA: 1e9, GAy: 1e9, GAz: 1e9, GJ: 1e8, EIy: 1e8, EIz: 1e8, mass_per_length: 1, Jx: 0.02, Jy: 0.01, Jz: 0.01}}
    {2}
joints: {{shaft: {{type: hinge, nodes: [ground, root], axis: [0, 0, 1]}}}}
{3})yaml",
                     rate, rate * length, load, more);
}

/// Returns a clamped stiff blade in the wind, along x.
std::string held_blade(const std::string& load) {
  return fmt::format(R"yaml(
nodes: {{root: {{fixed: true}}, tip: {{position: [2, 0, 0]}}}}
elements:
  blade:
    type: beam
    nodes: [root, tip]
    elements: 3
    orientation: [0, 1, 0]
    section: {{EA: 1e12, GAy: 1e12, GAz: 1e12, GJ: 1e12, EIy: 1e12, EIz: 1e12}}
    {}
)yaml",
                     load);
}

}  // namespace test_loads_by_motion
using namespace test_loads_by_motion;

TEST_CASE("a beam whose load opposes its velocity slows down exponentially") {
  // m v' = -c v along any direction, whether the components are inertial or along the section.
  const std::string load =
      GENERATE("{force: [\"-3*vx\", \"-3*vy\", \"-3*vz\"]}",
               "{force: [\"-3*section_vx\", \"-3*section_vy\", \"-3*section_vz\"], follower: true}");
  CAPTURE(load);
  Session session = session_of(R"yaml(
nodes:
  a: {position: [0, 0, 0], rotation_vector: [0.3, 1, 0.2], velocity: [1, -2, 0.5]}
  b: {position: [1, 2, -1], velocity: [1, -2, 0.5]}
elements:
  rod: {type: beam, nodes: [a, b], elements: 3, twist: 0.5, section: {EA: 1e3, GAy: 1e3, GAz: 1e3, GJ: 10, EIy: 10, EIz: 10, mass_per_length: 2, Jx: 0.02, Jy: 0.01, Jz: 0.01}, distributed: )yaml" +
                               load + "}\n");
  Motion motion = session.dynamics(steps_of(1, 0.005));
  motion.finish();
  const double left = std::exp(-3.0 / 2);
  // The scheme has an error of (c h/m)^2/12 per unit of c t/m: 5e-6.
  const auto& nodes = session.state().nodes;
  const Vector3& v = nodes[static_cast<std::size_t>(*session.model().find_node("b"))].v;
  CHECK((v - left * Vector3(1, -2, 0.5)).norm() < 2e-5);
  const double mass = 2 * std::sqrt(6.0), begun = 0.5 * mass * (1 + 4 + 0.25);
  CHECK_THAT(motion.energy().input, WithinRel(-begun * (1 - left * left), 1e-4));
}

TEST_CASE("a rod in a fluid is stopped by the square of its speed") {
  // J w' = -rho c_d d l^4/8 w^2:  1/w = 1/w_0 + k t/J.
  const double c = 0.5 * rho * 1.1 * 0.2, k = c * std::pow(length, 4) / 4,
               J = 5 + std::pow(length, 3) / 3 + 0.01 * length;
  Session session = session_of(turning_blade(
      4, fmt::format("distributed: {{force: [0, \"-{:.17g}*section_vy*abs(section_vy)\", 0], follower: true}}", c),
      "measures: {speed: shaft.angle.rate}\n"));
  session.dynamics(steps_of(2, 0.005)).finish();
  CHECK_THAT(session.measure("speed"), WithinRel(1 / (0.25 + k * 2 / J), 1e-4));  // steps
}

TEST_CASE("strip theory written as a formula is that of an airfoil: thrust and torque of a rotating blade") {
  // Chord along -y of the motion, constant coefficients: per length q = rho/2 c (W r)^2; thrust cl l^3/3, torque cd
  // l^4/4 times rho c W^2/2.
  const double cl = 0.8, cd = 0.05, W = 7, q = 0.5 * rho * chord * W * W;
  const std::string by_formula = fmt::format(
      "distributed: {{force: [0, \"-{0:.17g}*section_vy*abs(section_vy)\", \"-{1:.17g}*section_vy*abs(section_vy)\"], "
      "follower: true}}",
      0.5 * rho * chord * cd, 0.5 * rho * chord * cl);
  const std::string by_airfoil =
      fmt::format("airfoil: {{density: 1.2, chord: 0.3, lift: {}, drag: {}, pitch_rate: false}}", cl, cd);
  const std::string load = GENERATE_COPY(by_formula, by_airfoil);
  CAPTURE(load);
  Session session = session_of(turning_blade(W, load, "drives: {motor: {joint: shaft, rate: 7}}\n"));
  session.dynamics(steps_of(0.05, 0.001)).finish();
  // The blade, whose oscillations decay within 1e-3 s, is deflected by 1e-7 of its length.
  CHECK_THAT(session.read("joints/shaft/drive_force")[0], WithinRel(q * cd * std::pow(length, 4) / 4, 1e-5));
  const double lift = -q * cl * std::pow(length, 3) / 3;
  CHECK_THAT(session.read("joints/shaft/reaction")[2], WithinRel(-lift, 1e-5));
}

TEST_CASE("a load that a measure of the deflection relieves is in equilibrium with it") {
  // Small deflection: w = C (q - k w), C = l^4/(8 EI).
  const double C = 16.0 / (8 * 1e5), k = 3e4, q = 20;
  Session session = session_of(R"yaml(
nodes: {root: {fixed: true}, tip: {position: [2, 0, 0]}}
elements:
  blade: {type: beam, nodes: [root, tip], elements: 3, section: {EA: 1e9, GAy: 1e11, GAz: 1e11, GJ: 1e5, EIy: 1e5, EIz: 1e5}, distributed: {force: [0, 0, "level - 3e4*tip.position.z"]}}
inputs: {level: 20}
measures: {up: tip.position.z}
)yaml");
  compute_statics(session);
  CHECK_THAT(session.measure("up"), WithinRel(C * q / (1 + k * C), 1e-6));
}

TEST_CASE("polars of stations are interpolated along the blade") {
  // The lift is 0.4 up to s = 0.25 and 1 from 0.75 on, linear between them; the drag is 0.02 and 0.05 likewise.
  const double q = 0.5 * rho * chord * 100 * length;
  const std::string load = GENERATE("polars: [{at: 0.25, lift: 0.4, drag: 0.02}, {at: 0.75, lift: 1, drag: 0.05}]",
                                    "polars: [{at: 0.25, table: [[-180, 0.4, 0.02, 0], [180, 0.4, 0.02, 0]], angles: "
                                    "deg}, {at: 0.75, table: [[-3.2, 1, 0.05, 0], [3.2, 1, 0.05, 0]]}]",
                                    "lift: \"if(s < 0.25, 0.4, if(s < 0.75, 0.4 + 1.2*(s - 0.25), 1))\", drag: "
                                    "\"if(s < 0.25, 0.02, if(s < 0.75, 0.02 + 0.06*(s - 0.25), 0.05))\"");
  CAPTURE(load);
  Session session = session_of(held_blade("airfoil: {density: 1.2, chord: 0.3, wind: [0, 10, 0], " + load + "}"));
  compute_statics(session);
  const auto reaction = session.read("supports/root/reaction");
  CHECK_THAT(reaction[2], WithinRel(-q * 0.7, 1e-9));
  CHECK_THAT(reaction[1], WithinRel(-q * 0.035, 1e-9));
}

TEST_CASE("a table of a polar has the coefficients of its angles, and ends where it ends") {
  const auto blade = [](double twist, const char* angles) {
    return held_blade(
        fmt::format("airfoil: {{density: 1.2, chord: 0.3, twist: {:.17g}, wind: [0, 10, 0], polars: [{{at: 0.5, "
                    "angles: {}, table: [[-10, -1, 0.03, 0], [0, 0, 0.01, 0], [10, 1, 0.03, 0]]}}]}}",
                    twist, angles));
  };
  Session session = session_of(blade(-4 * M_PI / 180, "deg"));
  compute_statics(session);
  const double q = 0.5 * rho * chord * 100 * length;
  CHECK_THAT(session.read("supports/root/reaction")[2], WithinRel(-0.4 * q, 1e-9));
  CHECK_THAT(session.read("supports/root/reaction")[1], WithinRel(-0.018 * q, 1e-9));
  CHECK_THAT(message_of<bielle::InputError>([&] { session_of(blade(0, "rad")); }), Contains("angles: deg"));
  CHECK_THAT(message_of<bielle::ComputationError>([&] {
               Session stalled = session_of(blade(-11 * M_PI / 180, "deg"));
               compute_statics(stalled);
             }),
             Contains("outside the table"));
}
