// A slider-crank with a flexible rod: data of the IVP test set's problem "crank" (B. Simeon, Modelling a flexible
// slider crank mechanism by a mixed system of DAEs and PDEs, Math. Model. Sys. 2 (1996) 1): crank 0.15 m driven at 150
// rad/s, rod 0.30 m of 8 x 8 mm, E = 2e11, nu = 0.3, density 7870, slider 0.075552 kg, no gravity. Here the rod starts
// straight and undeformed with the velocities of a rigid rod. Reference: geometrically exact rod (GA = 5/6 G A) by
// nodal spectral elements and Runge-Kutta, converged to some 1e-8 m in the deflection of the midpoint: extremes
// +1.87059e-3 (t = 0.04778) and -1.87011e-3 m, slider at t = 0.1: 0.16974254 m.
#include <catch2/catch.hpp>

#include "mechanism/io/energy_balance.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// The mechanism in the plane, in line at the start; the rod spans the nodes `a` and `b`.
std::string slider_crank(const std::string& rod) {
  return R"yaml(
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 0, 150]}
  pin: {position: [0.15, 0, 0]}
  a: {position: [0.15, 0, 0], velocity: [0, 22.5, 0], angular_velocity: [0, 0, -75]}
  b: {position: [0.45, 0, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [0.0014, 0.0014, 0.002727], also: [pin]}
  slider: {type: point_mass, node: slider, mass: 0.075552}
)yaml" + rod +
         R"yaml(
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [pin, a], axis: [0, 0, 1]}
  wrist: {type: hinge, nodes: [b, slider], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
drives: {motor: {joint: main, angle: "150*t"}}
)yaml";
}

std::string beam_rod(int elements) {
  return "  rod: {type: beam, nodes: [a, b], elements: " + std::to_string(elements) +
         ", section: {rectangle: [0.008, 0.008], young: 2e11, poisson: 0.3, density: 7870, "
         "shear_factors: [0.8333333333333333, 0.8333333333333333]}}\n";
}

/// Deflection of a point beside the line between a and b, positive to the left of the way from a to b.
double deflection(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).normalized();
  return Vector3(-along.y(), along.x(), 0).dot(point - a);
}

}  // namespace

TEST_CASE("a flexible rod of eight beams deflects as the geometrically exact reference") {
  const ReadyModel model(slider_crank(beam_rod(8)));
  double lowest = 0, highest = 0;
  EnergyBalance books;
  const State end = integrate(model, Scheme::generalized_alpha(0.9), 2e-5, 0.1, [&](const State& state) {
    const double w = deflection(model.node(state, "rod.4").x, model.node(state, "a").x, model.node(state, "b").x);
    lowest = std::min(lowest, w);
    highest = std::max(highest, w);
    const Energy energy = model.system.energy(state, model.environment());
    if (state.time == 0)
      books.start(0, energy);
    else
      books.advance(state.time, energy);
  });
  // Eight elements of fourth order in frequency are within 1e-3 of the rod; the step resolves its first mode 70 times.
  CHECK(highest == Approx(1.87059e-3).epsilon(5e-3));
  CHECK(lowest == Approx(-1.87011e-3).epsilon(5e-3));
  // The start sets off an undamped axial vibration of the slider on the rod (19e3 rad/s, amplitude m a l/EA = 1e-5 m)
  // whose phase after 300 periods is not resolved.
  CHECK(model.node(end, "b").x.x() == Approx(0.16974254).margin(2e-5));
  // Work of the drive against kinetic and elastic energy: the scheme dissipates in the axial modes only.
  CHECK(std::abs(books.balance()) < 2e-3 * books.largest());
}
