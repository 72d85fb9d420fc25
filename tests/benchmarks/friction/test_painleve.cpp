// A rod that is dragged over a rough plane on its end, with the rigid contact of a point on a plane: below Painleve's
// limit the normal force is the closed form; beyond it the run reports that there is no solution.
//
// Uniform rod of half length l, inclined by tan(theta) = 2, its end sliding away from its middle:
//     N [1/m + l^2 cos(theta) (cos(theta) - mu sin(theta))/J] = g,   J = m l^2/3,
// the bracket is zero at mu = 4/3, the least value for which a uniform rod meets the paradox at any inclination. P.
// Painleve, C. R. Acad. Sci. Paris 121 (1895) 112-115; F. Genot, B. Brogliato, Eur. J. Mech. A/Solids 18 (1999) 653.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using Catch::Contains;
using Catch::WithinRel;

namespace test_painleve {
namespace {

constexpr double m = 1.3, l = 0.7, g = 9.81, J = m * l * l / 3;
const double c = 1 / std::sqrt(5), s = 2 / std::sqrt(5);

/// @param velocity  velocity of the rod along x [m/s]
std::string rod(double mu, double velocity) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{rod: {{position: [{:.17g}, 0, {:.17g}], velocity: [{}, 0, 0]}}}}
elements: {{rod: {{type: rigid_body, node: rod, mass: 1.3, inertia: [{:.17g}, {:.17g}, {:.17g}]}}}}
joints: {{tip: {{type: point_on_plane, nodes: [ground, rod], position: [0, 0, 0], normal: [0, 0, 1],
               friction: {{coefficient: {}, velocity: 1e-4}}}}}}
)yaml",
                     l * c, l * s, velocity, J, J, J, mu);
}

double force(double mu, double velocity) {
  double N = 0;
  bool first = true;
  bielle::test::move(
      rod(mu, velocity), 1e-3, 1e-3,
      [&](const Session& session) {
        if (first) N = session.read("joints/tip/normal_force")[0];
        first = false;
      },
      true);
  return N;
}

}  // namespace

TEST_CASE("a dragged rod has the normal force of the closed form, and none beyond Painleve's limit") {
  for (const double mu : {0.3, 1.0, 1.3}) {
    CAPTURE(mu);
    CHECK_THAT(force(mu, -1), WithinRel(g / (1 / m + l * l * c * (c - mu * s) / J), 1e-8));
    // If its end slides towards its middle, friction turns the rod off the plane.
    CHECK_THAT(force(mu, 1), WithinRel(g / (1 / m + l * l * c * (c + mu * s) / J), 1e-8));
  }
  // The plane holds from both sides: with a push or a pull, which have opposite friction, there is no solution or there
  // are two.
  CHECK_THROWS_WITH(force(1.4, -1), Contains("Painleve") && Contains("joint 'tip'"));
  CHECK_THROWS_WITH(force(1.4, 1), Contains("Painleve") && Contains("joint 'tip'"));
}

}  // namespace test_painleve
