// Accumulators at and across their precharge, where the compliance of a volume grows a thousandfold.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"

using namespace bielle::mechanism;
using bielle::test::run_hydraulics;

namespace test_accumulators {
namespace {

constexpr double modulus = 1.4e9, gas = 1e-3, precharge = 5e6, volume = 1e-4;

/// Returns a volume of 0.1 l with an accumulator of 1 l of gas at 5 MPa.
std::string store(double pressure, const std::string& flow) {
  return fmt::format(R"yaml(
hydraulics:
  fluid: {{density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}}
  volumes: {{main: {{volume: 1e-4, pressure: {}}}}}
  supplies: {{pump: {{to: main, flow: "{}"}}}}
  accumulators: {{store: {{at: main, gas_volume: 1e-3, precharge: 5e6, exponent: 1}}}}
measures: {{fluid: store.fluid_volume}}
)yaml",
                     pressure, flow);
}

double pressure_of(const Session& session) { return session.read("hydraulics/main/pressure")[0]; }

/// Returns the volume of fluid that is pushed in from the precharge to a pressure: the integral of V dp/B, and the
/// volume that the accumulator takes.
double fluid_to(double p) {
  if (p <= precharge) return volume * (p - precharge) / modulus;
  const double taken = gas * (1 - precharge / p);
  return taken + ((volume + gas) * (p - precharge) - gas * precharge * std::log(p / precharge)) / modulus;
}

}  // namespace
}  // namespace test_accumulators
using namespace test_accumulators;

TEST_CASE("an accumulator that begins at its precharge is filled in steps without difficulties") {
  for (const double start : {precharge, 4.9e6, 5.1e6})
    for (const double h : {2e-3, 0.01}) {
      CAPTURE(start, h);
      const double flow = fluid_to(1e7) - fluid_to(start);
      double last = 0;
      const MarchLog log = run_hydraulics(store(start, fmt::format("{:.17g}", flow)), {.h = h},
                                          [&](const Session& session) { last = pressure_of(session); });
      CHECK(last == Approx(1e7).epsilon(1e-5));
      CHECK(log.refused_by_newton == 0);
      CHECK(log.crossings == (start < precharge ? 1 : 0));
    }
}

TEST_CASE("an accumulator that begins at its precharge and empties leaves a stiff volume") {
  const double flow = fluid_to(4e6);
  double last = 0;
  const MarchLog log =
      run_hydraulics(store(precharge, fmt::format("{:.17g}", flow)), {.h = 0.01}, [&](const Session& session) {
        last = pressure_of(session);
        // A step ends 1e-8 of the precharge below it.
        CHECK(session.measure("fluid") == Approx(0).margin(1.1e-8 * gas));
      });
  CHECK(last == Approx(4e6).epsilon(1e-5));
  CHECK(log.refused_by_newton == 0);
}

TEST_CASE("an accumulator at its precharge without a flow stays there") {
  const MarchLog log = run_hydraulics(store(precharge, "0*t"), {.h = 0.01}, [&](const Session& session) {
    CHECK(pressure_of(session) == Approx(precharge).epsilon(1e-9));
  });
  CHECK(log.crossings == 0);
  CHECK(log.steps == 100);
}

TEST_CASE("a pulsating flow fills and empties an accumulator across its precharge along one curve") {
  const double below = fluid_to(3e6);
  for (const double tolerance : {0.0, 1e-6}) {
    int filled = 0, empty = 0;
    const MarchLog log =
        run_hydraulics(store(3e6, "1e-4*sin(20*t)"), {.h = 1e-3, .end = 1, .tolerance = tolerance, .rho = 1},
                       [&](const Session& session) {
                         const double p = pressure_of(session), t = session.time();
                         const double pushed = below + 1e-4 / 20 * (1 - std::cos(20 * t));
                         CAPTURE(t, p);
                         // The error is that of the flow by the trapezoidal rule, and the change of the modulus with
                         // the pressure.
                         CHECK(fluid_to(p) == Approx(pushed).margin(1e-8));
                         (p > precharge ? filled : empty) += 1;
                       });
    CHECK(filled > 50);
    CHECK(empty > 5);
    CHECK(log.refused_by_newton == 0);
    CHECK(log.crossings == 7);  // upwards in each of the four periods that begin, downwards in three
  }
}
