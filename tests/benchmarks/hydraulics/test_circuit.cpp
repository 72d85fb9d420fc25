// Circuits: quantities that closed circuits conserve (mass, energy), volumes that cavitate or contain air, and starts
// that follow from the load.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Returns a mass of 500 kg above the ground, lifted and lowered by a cylinder in a closed circuit: a machine on a
/// flywheel pumps from one chamber to the other, past an accumulator, a check valve and a leaking piston.
std::string closed_circuit(const std::string& conserves) {
  return R"yaml(
gravity: [0, 0, -9.81]
nodes:
  mass: {position: [0, 0, 1.2], fixed: [x, y, rx, ry, rz]}
  wheel: {angular_velocity: [0, 0, 30]}
elements:
  load: {type: point_mass, node: mass, mass: 500}
  wheel: {type: rigid_body, node: wheel, mass: 5, inertia: [0.5, 0.5, 0.8]}
  jack: {type: hydraulic_actuator, nodes: [ground, mass], piston_areas: [2e-3, 1.5e-3], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5], ports: [lift, sink], leakage: 2e-12, friction: {viscous: 300}}
joints:
  axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}
hydraulics:
  fluid: {air_fraction: 0.01, conserves: )yaml" +
         conserves + R"yaml(}
  volumes:
    lift: {volume: 1e-4, pressure: 6e6}
    sink: {volume: 1e-4, pressure: 4e6, compliance: 1e-13}
  accumulators:
    store: {at: sink, gas_volume: 1e-3, precharge: 2e6}
  lines:
    back: {from: lift, to: sink, relief: {pressure: 4e6, diameter: 2e-3}}
  machines:
    pump: {joint: axle, from: sink, to: lift, displacement: 2e-6, leakage: 1e-12, drag: 1e-3}
)yaml";
}

struct Kept {
  double fluid;   ///< W of both volumes, largest change relative to what there is
  double energy;  ///< error of the energy at the end [J]
  double moved;   ///< distance that the mass moved [m]
};
Kept run_closed(const std::string& conserves, double h) {
  Kept kept{0, 0, 0};
  double first = 0;
  run_hydraulics(closed_circuit(conserves), {.h = h, .end = 0.4, .rho = 1}, [&](const Session& session) {
    const double W = session.read("hydraulics/lift/fluid")[0] + session.read("hydraulics/sink/fluid")[0];
    if (first == 0) first = W;
    kept.fluid = std::max(kept.fluid, std::abs(W / first - 1));
    kept.moved = std::max(kept.moved, std::abs(session.read("elements/jack/length")[0] - 1.2));
    kept.energy = session.balance();
  });
  return kept;
}

}  // namespace

TEST_CASE("a closed circuit keeps its mass to rounding where flows conserve mass") {
  const Kept kept = run_closed("mass", 1e-3);
  CHECK(kept.fluid < 1e-13);
  CHECK(kept.moved > 0.01);
  // The law of the textbook conserves volumes, each at its own pressure: mass appears and vanishes in proportion to
  // pressures over B.
  CHECK(run_closed("volume", 1e-3).fluid > 1e-7);
}

TEST_CASE("energy balances in a closed circuit: what is missing falls with the square of the step") {
  for (const char* conserves : {"mass", "volume"}) {
    CAPTURE(conserves);
    const double coarse = run_closed(conserves, 1e-3).energy, fine = run_closed(conserves, 5e-4).energy;
    INFO("missing " << coarse << " and " << fine << " J");
    CHECK(std::abs(fine) < 0.35 * std::abs(coarse));
    CHECK(std::abs(fine) < 0.1);  // relative to about 400 J of the flywheel
  }
}

TEST_CASE("the fluid: volumes, modulus and work by their closed forms") {
  Fluid fluid;
  fluid.air_fraction = 0.005;
  // The reference is the effective moduli by direct evaluation of -v/v' in quadruple precision.
  CHECK(fluid.effective_modulus(1e3) == Approx(6.289e3).epsilon(1e-3));
  CHECK(fluid.effective_modulus(1e6) == Approx(7.4899e8).epsilon(1e-4));
  CHECK(fluid.effective_modulus(20e6) == Approx(1.3950e9).epsilon(1e-4));
  for (const double air : {0.0, 0.005, 0.3}) {
    fluid.air_fraction = air;
    for (const double exponent : {1.0, 1.2}) {
      fluid.air_exponent = exponent;
      for (const double p : {1e-3, 30., 2e3, 9e4, 2e5, 3e7}) {
        CAPTURE(air, exponent, p);
        const double e = 1e-5 * p;
        // The inverse converges from any guess.
        for (const double guess : {-1., 1e5, 4e7})
          CHECK(fluid.pressure_of(fluid.ratio(p).v, guess) == Approx(p).epsilon(1e-12).margin(1e-6));
        // v is the derivative of the work, and v' the derivative of v.
        CHECK((fluid.ratio(p + e).v - fluid.ratio(p - e).v) / (2 * e) == Approx(fluid.ratio(p).v_p).epsilon(1e-5));
        if (p > 1) CHECK((fluid.work(p + e) - fluid.work(p - e)) / (2 * e) == Approx(fluid.ratio(p).v).epsilon(1e-4));
        for (const auto conserves : {Fluid::Conserves::volume, Fluid::Conserves::mass}) {
          fluid.conserves = conserves;
          if (p > 1)
            CHECK((fluid.head(p + e).e - fluid.head(p - e).e) / (2 * e) == Approx(fluid.head(p).e_p).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("a closed chamber that is drawn out cavitates, and closes with the fluid that it had") {
  // Half a litre is expanded to twice its volume and compressed again, without air and with it.
  for (const char* air : {"0", "0.01"}) {
    const std::string drawn = fmt::format(
        "nodes:\n  end: {{position: [0, 0, 1.5], motion: {{z: \"0.5*step(t, 0, 0.2) - 0.5*step(t, 0.2, 0.4)\"}}, "
        "fixed: [x, y, rx, ry, rz]}}\n"
        "elements:\n  jack: {{type: hydraulic_actuator, nodes: [ground, end], piston_areas: [1e-3, 0], dead_volumes: "
        "[1e-5], stroke: [1, 2.1], pressures: [5e6], air_fraction: {}}}\n",
        air);
    double lowest = 1e9, last = 0, fluid = 0, change = 0;
    run_hydraulics(drawn, {.h = 2e-3, .end = 0.4}, [&](const Session& session) {
      const double p = session.read("elements/jack/pressure")[0],
                   W = session.read("hydraulics/jack.chamber_1/fluid")[0];
      if (fluid == 0) fluid = W;
      change = std::max(change, std::abs(W / fluid - 1));
      lowest = std::min(lowest, p);
      last = p;
    });
    CAPTURE(air);
    CHECK(change < 1e-14);
    CHECK(lowest > 0);
    CHECK(lowest < 3e3);  // vapour, or air of two hundred times its volume
    CHECK(last == Approx(5e6).epsilon(1e-7));
  }
}

TEST_CASE("pressures at the start that are not given hold the load") {
  // The load pushes, pulls, and acts on a single-acting cylinder; the mass does not move.
  struct Load {
    const char *areas, *position;
    double p1, p2;
  };
  constexpr double weight = 500 * 9.81, p_a = 101325;
  for (const Load& load :
       {Load{"[2e-3, 1.2e-3]", "1.2", p_a + weight / 2e-3, p_a},
        Load{"[2e-3, 1.2e-3]", "-1.2", p_a, p_a + weight / 1.2e-3}, Load{"[2e-3, 0]", "1.2", p_a + weight / 2e-3, 0}}) {
    const std::string text = fmt::format(
        "gravity: [0, 0, -9.81]\nnodes:\n  mass: {{position: [0, 0, {}], fixed: [x, y, rx, ry, rz]}}\n"
        "elements:\n  load: {{type: point_mass, node: mass, mass: 500}}\n  jack: {{type: hydraulic_actuator, nodes: "
        "[ground, mass], piston_areas: {}, dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5]}}\n",
        load.position, load.areas);
    CAPTURE(load.areas, load.position);
    run_hydraulics(text, {.h = 1e-2, .end = 0.1}, [&](const Session& session) {
      const std::vector<double> p = session.read("elements/jack/pressure");
      CHECK(p[0] == Approx(load.p1).epsilon(1e-9));
      if (p.size() > 1) CHECK(p[1] == Approx(load.p2).epsilon(1e-9));
      CHECK(session.read("elements/jack/length")[0] == Approx(1.2).epsilon(1e-12));
    });
  }
}

TEST_CASE("cylinders that hold the same load share it by the forces of smallest norm") {
  // A rigid slab stands on three cylinders of different areas, one more than balance determines. Among all forces with
  // sum F = W and sum x F = W c, those of smallest sum of squares are linear in x: F = W/3 + W (c - 1)(x - 1)/2.
  constexpr double weight = 500 * 9.81, p_a = 101325, c = 1.2;
  std::string text =
      "gravity: [0, 0, -9.81]\nnodes:\n  slab: {position: [1.2, 0, 1.2], fixed: [x, y, rx, rz]}\n"
      "elements:\n  slab: {type: rigid_body, node: slab, mass: 500, inertia: [100, 100, 200]}\n";
  const std::vector<double> areas = {2e-3, 1e-3, 3e-3};
  for (int k = 0; k < 3; ++k)
    text += fmt::format(
        "  jack_{0}: {{type: hydraulic_actuator, nodes: [ground, slab], at: [[{0}, 0, 0], [{1}, 0, 0]], "
        "piston_areas: [{2}, 0], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5]}}\n",
        k, k - c, areas[static_cast<std::size_t>(k)]);
  const auto check = [&](const Session& session) {
    for (int k = 0; k < 3; ++k) {
      CAPTURE(k);
      const double force = weight / 3 + weight * (c - 1) * (k - 1) / 2;
      const std::string jack = fmt::format("elements/jack_{}/", k);
      CHECK(session.read(jack + "force")[0] == Approx(force).epsilon(1e-6));
      CHECK(session.read(jack + "pressure")[0] ==
            Approx(p_a + force / areas[static_cast<std::size_t>(k)]).epsilon(1e-6));
      CHECK(session.read(jack + "length")[0] == Approx(1.2).epsilon(1e-9));
    }
  };
  SECTION("in motion") { run_hydraulics(text, {.h = 1e-2, .end = 0.1}, check); }
  SECTION("in statics") {
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    compute_statics(session);
    check(session);
  }
}

TEST_CASE("statics: trapped oil gives under a load as its stiffness says") {
  // For a small load, k = B (A_1^2/V_1 + A_2^2/V_2).
  const std::string text =
      "nodes:\n  mass: {position: [0, 0, 1.25], fixed: [x, y, rx, ry, rz]}\n"
      "elements:\n  jack: {type: hydraulic_actuator, nodes: [ground, mass], piston_areas: [2e-3, 1.2e-3], "
      "dead_volumes: "
      "[5e-4, 5e-4], stroke: [1, 1.5], pressures: [6e6, 1e7], ambient_pressure: 0}\n"
      "loads:\n  push: {node: mass, force: [0, 0, -10]}\n";
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  constexpr double B = 1.4e9, V1 = 5e-4 + 2e-3 * 0.25, V2 = 5e-4 + 1.2e-3 * 0.25;
  const double k = B * (2e-3 * 2e-3 / V1 + 1.2e-3 * 1.2e-3 / V2);
  CHECK(session.read("elements/jack/length")[0] - 1.25 == Approx(-10 / k).epsilon(1e-4));
}
