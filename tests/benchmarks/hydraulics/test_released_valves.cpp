// Valves and orifices that events release and activate: closed, they pass nothing.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::at_end;
using bielle::test::message_of;
using bielle::test::run_hydraulics;
using Catch::Contains;

namespace test_released_valves {
namespace {

constexpr double fluid_modulus = 1.4e9, space = 1e-3, conductance = 1e-12, low = 1e5, high = 3e5;

/// Returns a volume between two gaps, of which `in` leads from the higher pressure.
std::string filled(const std::string& in, const std::string& events) {
  return fmt::format(R"yaml(
hydraulics:
  fluid: {{density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}}
  volumes: {{v: {{volume: 1e-3, pressure: 2e5}}}}
  supplies: {{pump: {{pressure: 3e5}}, tank: {{pressure: 1e5}}}}
  lines:
    in: {{from: pump, to: v, laminar: {{conductance: 1e-12}}{}}}
    out: {{from: v, to: tank, laminar: {{conductance: 1e-12}}}}
measures: {{inflow: in.flow}}
states: {{clock: {{rate: 1}}}}
events: {{{}}}
)yaml",
                     in, events);
}

}  // namespace
}  // namespace test_released_valves
using namespace test_released_valves;

TEST_CASE("a volume empties from the instant at which its supply is released, and fills again when it is activated") {
  // p' = G B/V times the differences of pressure; B changes by 1e-4 with the pressure.
  const double rate = conductance * fluid_modulus / space, closed = 0.5137, opened = 1.2;
  const std::string text = filled("",
                                  "close: {when: clock, crosses: 0.5137, do: [{release: in}]}, open: {when: clock, "
                                  "crosses: 1.2, do: [{activate: in}]}");
  const double emptied = low + (0.5 * (low + high) - low) * std::exp(-rate * (opened - closed));
  double most = 0;
  run_hydraulics(text, {.h = 2e-3, .end = 2, .rho = 1}, [&](const Session& session) {
    const double t = session.time(), p = session.read("hydraulics/v/pressure")[0];
    const double expected = t <= closed   ? 2e5
                            : t <= opened ? low + 1e5 * std::exp(-rate * (t - closed))
                                          : 2e5 + (emptied - 2e5) * std::exp(-2 * rate * (t - opened));
    most = std::max(most, std::abs(p - expected));
    const bool flows = t < closed - 1e-6 || t > opened + 1e-6;
    if (std::abs(t - closed) < 1e-6 || std::abs(t - opened) < 1e-6) return;
    const double flow = flows ? conductance * (high - p) : 0;
    CHECK(session.read("hydraulics/in/flow")[0] == Approx(flow).margin(1e-18));
    CHECK(session.measure("inflow") == Approx(flow).margin(1e-18));
  });
  CHECK(most < 1e5 * 3e-4);
}

TEST_CASE("a line that is not active from the start passes nothing until an event activates it") {
  const double rate = conductance * fluid_modulus / space;
  const double p = at_end(filled(", active: false", ""), {.h = 2e-3, .end = 1, .rho = 1}, {"hydraulics/v/pressure"})[0];
  CHECK(p == Approx(low + 1e5 * std::exp(-rate)).epsilon(3e-4));
}

TEST_CASE("a junction all of whose lines are released keeps its pressure") {
  const std::string text = R"yaml(
hydraulics:
  fluid: {density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}
  junctions: [j]
  supplies: {pump: {pressure: 3e5}, tank: {pressure: 1e5}}
  lines:
    in: {from: pump, to: j, orifice: {diameter: 1e-3}}
    out: {from: j, to: tank, valve: {diameter: 1e-3, command: 1, time_constant: 0.1}}
states: {clock: {rate: 1}}
events:
  first: {when: clock, crosses: 0.05, do: [{release: in}]}
  second: {when: clock, crosses: 0.1, do: [{release: out}]}
)yaml";
  run_hydraulics(text, {.h = 0.01, .end = 0.2}, [&](const Session& session) {
    const double t = session.time(), p = session.read("hydraulics/j/pressure")[0];
    if (t < 0.049) CHECK(p == Approx(2e5).epsilon(1e-9));
    if (t > 0.051) CHECK(p == Approx(1e5).epsilon(1e-6));
    if (t > 0.11) CHECK(session.read("hydraulics/out/flow")[0] == 0);
  });
}

TEST_CASE("places and pipes of the hydraulics cannot be released") {
  const auto refusal = [](const std::string& name) {
    return message_of<bielle::InputError>([&] {
      read_mechanism_text(filled("", "close: {when: clock, crosses: 0.5, do: [{release: " + name + "}]}"),
                          "model.yaml");
    });
  };
  CHECK_THAT(refusal("v"), Contains("'v' is no orifice or valve"));
  CHECK_THAT(refusal("tank"), Contains("no orifice or valve"));
  CHECK_THAT(refusal("inn"), Contains("no joint, element, drive, load or valve 'inn'") && Contains("'in'"));
}
