// Heads of the compressible fluid: torques of machines, waves in pipes, for both conservation laws of flows.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_heads {
namespace {

constexpr double B = 1.4e9, rho = 850, p_a = 101325;

/// Returns the work per volume that enters a place at a difference d to the ambient pressure. Fluid that has the volume
/// W at p_a has W exp(-d/B) there, and its work is the integral of that, W B (1 - exp(-d/B)).
double head(const std::string& conserves, double d) {
  return conserves == "mass" ? -B * std::expm1(-d / B) : B * std::expm1(d / B);
}

}  // namespace

TEST_CASE("the torque of a machine is displacement times head: p/(2 B) more than pressure, or less") {
  for (const std::string& conserves : {std::string("volume"), std::string("mass")}) {
    const auto torque = [&](double p, double back) {
      return at_end(
          fmt::format(
              "nodes: {{wheel: {{}}}}\nelements: {{wheel: {{type: rigid_body, node: wheel, mass: 1, inertia: [1, "
              "1, 1]}}}}\njoints: {{axle: {{type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}}}\n"
              "hydraulics:\n  fluid: {{bulk_modulus: {}, conserves: {}}}\n  supplies: {{high: {{pressure: "
              "{:.17g}}}, low: {{pressure: {:.17g}}}}}\n  machines: {{motor: {{joint: axle, from: high, to: low, "
              "displacement: 8e-6}}}}\n",
              B, conserves, p_a + p, p_a + back),
          {.h = 1e-2, .end = 1e-2}, {"hydraulics/motor/torque"})[0];
    };
    CAPTURE(conserves);
    CHECK(torque(2e7, 0) == Approx(8e-6 * head(conserves, 2e7)).epsilon(1e-9));
    CHECK(torque(3e7, 1e7) == Approx(8e-6 * (head(conserves, 3e7) - head(conserves, 1e7))).epsilon(1e-9));
    CHECK(torque(0, 2e7) == Approx(-torque(2e7, 0)).epsilon(1e-12));
    // The manual states this value: 0.7 % at 20 MPa.
    CHECK(torque(2e7, 0) / (8e-6 * 2e7) - 1 == Approx((conserves == "mass" ? -1 : 1) * 2e7 / (2 * B)).epsilon(0.01));
  }
}

TEST_CASE("small waves in a pipe under pressure have Joukowsky's height, whatever flows conserve") {
  // Fluid at rest at 40 MPa, which is 3 % of B, is drawn from one end with a velocity w: the pressure there falls by
  // rho c w with c = sqrt(B/rho), until the wave comes back from the other end.
  constexpr double L = 10, d = 0.02, S = M_PI * d * d / 4, w = 0.05, p_0 = 4e7;
  const double c = std::sqrt(B / rho);
  for (const std::string& conserves : {std::string("volume"), std::string("mass")}) {
    // Flows are volumes at their pressure, or at the atmosphere's.
    const double q = conserves == "mass" ? w * S * std::exp((p_0 - p_a) / B) : w * S;
    const std::string drawn = fmt::format(
        "hydraulics:\n  fluid: {{bulk_modulus: {}, density: {}, viscosity: 1e-6, conserves: {}}}\n  junctions: [end]\n"
        "  supplies: {{reservoir: {{pressure: {}}}, out: {{to: end, flow: \"-{:.17g}*step(t, 0, 0.002)\"}}}}\n"
        "  lines: {{main: {{from: reservoir, to: end, pipe: {{length: {}, diameter: {}, cells: 100, pressure: "
        "{}}}}}}}\n",
        B, rho, conserves, p_0, q, L, d, p_0);
    double fall = 0;
    long count = 0;
    // Time at which the front passes two cells that are 40 apart, each a hundredth of the pipe (and half a one) long.
    double passed[2] = {0, 0}, before[2] = {0, 0}, last = 0;
    run_hydraulics(drawn, {.h = 2.5e-5, .end = 1.9 * L / c, .rho = 0.6}, [&](const Session& session) {
      const double t = session.time() - 0.001, half = 0.5 * rho * c * w;
      if (t > 0.3 * L / c && t < 1.6 * L / c) {
        fall += p_0 - session.read("hydraulics/end/pressure")[0];
        ++count;
      }
      const std::vector<double> p = session.read("hydraulics/main/pressure");
      for (const int k : {0, 1}) {
        const double now = p_0 - p[k == 0 ? 90 : 50];
        if (passed[k] == 0 && now > half) passed[k] = last + (t - last) * (half - before[k]) / (now - before[k]);
        before[k] = now;
      }
      last = t;
    });
    CAPTURE(conserves);
    CHECK(fall / static_cast<double>(count) == Approx(rho * c * w).epsilon(2e-3));
    CHECK(passed[1] - passed[0] == Approx(40 * L / 100.5 / c).epsilon(5e-3));
  }
}

TEST_CASE("a fluid without vapour cavitates at no pressure, and one with vapour tends to it") {
  Fluid none, little;
  none.vapour_pressure = 0;
  little.vapour_pressure = 1;
  for (const double p : {2e3, 1e5, 3e7}) {
    CHECK(none.ratio(p).v == Approx(std::exp(-(p - Fluid::atmosphere) / none.bulk_modulus)).epsilon(1e-14));
    CHECK(none.work(p) == Approx(little.work(p)).margin(2));
    CHECK(none.pressure_of(none.ratio(p).v, 1e6) == Approx(p).epsilon(1e-8));
  }
  CHECK(none.pressure_of(2, 1e5) < 1e-2);  // twice its volume
  CHECK(none.pressure_of(2, 1e5) > 0);
  CHECK(none.pressure_of(2, 1e5) < little.pressure_of(2, 1e5));
}

}  // namespace test_heads
