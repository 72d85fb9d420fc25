// Deflections of a ball bearing under radial, axial, combined and tilting loads, and the axial force of a bearing that
// is loaded on half of its circumference, against published numbers.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/joints/flexible/rolling_bearing_law.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::session_of;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace test_bearing_references {
namespace {

/// Displacements [m] along x and z and the turn about y [rad] of a shaft in a bearing with the dimensions of a 6305:
/// seven balls of 11.5 mm on a pitch circle of 43.5 mm, grooves of 0.52 and 0.53 ball diameters, no contact angle.
Vector3 deflection(const std::string& load, double clearance) {
  Session session = session_of(fmt::format(R"yaml(
nodes: {{shaft: {{}}}}
elements: {{shaft: {{type: rigid_body, node: shaft, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}}}
joints:
  it: {{type: ball_bearing, nodes: [ground, shaft], axis: [0, 0, 1], second_axis: [1, 0, 0], elements: 7, pitch_diameter: 0.0435, ball_diameter: 0.0115, grooves: [0.52, 0.53], young: 210e9, poisson: 0.3, clearance: {:.17g}, discrete: true}}
  turn: {{type: bearing, nodes: [ground, shaft], axis: [0, 0, 1], radial: 0, stiffness: {{angle: 1}}}}
loads: {{push: {{node: shaft, {}}}}}
measures: {{x: shaft.position.x, z: shaft.position.z, tilt: shaft.rotation.y}}
)yaml",
                                           clearance, load));
  StaticsOptions options;
  options.steps = 10;
  compute_statics(session, options);
  return {session.measure("x"), session.measure("z"), session.measure("tilt")};
}

}  // namespace
}  // namespace test_bearing_references

using namespace test_bearing_references;

// The reference values are those with which the project github.com/minzhun/ISO16281 (Test_BallBearing.py, commit
// 1b0e9de, examples 1 to 6) compares its program of ISO/TS 16281: 1000 N or 1000 N mm on a bearing of type 6305, by the
// program MASTA as the names there say. They have six digits, and the constant 1.48 of the standard has three.
TEST_CASE("a deep groove ball bearing has the deflections of ISO/TS 16281") {
  constexpr double digits = 3e-5;
  const std::string radial = "force: [1000, 0, 0]", axial = "force: [0, 0, 1000]";
  CHECK_THAT(deflection(radial, 0)[0], WithinRel(15.1101e-6, digits));
  CHECK_THAT(deflection(axial, 0)[1], WithinRel(133.5381e-6, digits));
  CHECK_THAT(deflection(radial, 1e-5)[0], WithinRel(21.223e-6, digits));
  CHECK_THAT(deflection(axial, 1e-5)[1], WithinRel(149.1717e-6, digits));
  // The reference tilts the ring about circles of the pitch radius; here the contacts are on that of the groove's
  // centre, (0.52 - 0.5) ball diameters farther out at zero contact angle. Without a moment, the tilt is inverse to it.
  const double radius = (21.75 + 0.02 * 11.5) / 21.75;
  const Vector3 both = deflection("force: [1000, 0, 1000]", 1e-5);
  CHECK_THAT(both[0], WithinRel(19.5923e-6, digits));
  CHECK_THAT(both[1], WithinRel(146.4603e-6, digits));
  CHECK_THAT(both[2], WithinRel(2.6872e-3 / radius, 2e-4));  // the radius to the grooves depends on the clearance
  // A moment also has a longer lever: loads Q grow with the third power of small axial displacements, moments with the
  // fourth, and the tilt falls with the power 5/4 of the radius.
  CHECK_THAT(-deflection("moment: [0, -1, 0]", 0)[2], WithinRel(3.6957e-3 / std::pow(radius, 1.25), 1e-3));
}

// NSK Technical Report CAT. No. E728g, section 5.1, equations for a load zone of half the circumference: F_a = 1.216
// F_r tan(alpha) with point contact, 1.260 with line contact.
TEST_CASE("the axial force of a bearing that is loaded on half its circumference is that of Sjovall's integrals") {
  for (const bool ball : {true, false}) {
    RollingGeometry geometry;
    geometry.ball = ball;
    geometry.exponent = ball ? 1.5 : 1.1;
    geometry.elements = 11;
    geometry.pitch_diameter = 2;
    geometry.contact_radius = 1;
    geometry.contact_angle = 0.4;
    geometry.groove_distance = 0.7;
    geometry.constant = 3;
    const Vector6 N = RollingBearingLaw(geometry, 0).calc(1e-6 * Vector6::UnitX(), Vector6::Zero()).N;
    CHECK_THAT(N[2] / (N[0] * std::tan(0.4)), WithinAbs(ball ? 1.216 : 1.260, 1e-3));
  }
}
