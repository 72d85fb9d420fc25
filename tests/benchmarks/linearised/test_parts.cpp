// Modes of actuators and superelements, and the records of the analysis about modes.
#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

TEST_CASE("the oil in a cylinder is a spring of B (A1^2/V1 + A2^2/V2)", "[linearised]") {
  // H. Merritt, Hydraulic Control Systems (1967), ch. 6. The ports are closed: the pressures in equilibrium have the
  // ratio A2/A1.
  constexpr double B = 1.4e9, A1 = 2e-3, A2 = 1.2e-3, V1 = 1e-3, V2 = 0.2e-3 + 0.5 * A2, m = 500;
  const ModesReport report = ModesOf(
      "nodes: {mass: {position: [0, 0, 1], fixed: [x, y, rx, ry, rz]}}\n"
      "elements:\n  load: {type: point_mass, node: mass, mass: 500}\n"
      "  jack: {type: hydraulic_actuator, nodes: [ground, mass], ambient_pressure: 0, bulk_modulus: 1.4e9, "
      "piston_areas: [2e-3, 1.2e-3], "
      "dead_volumes: [1e-3, 0.2e-3], stroke: [1, 1.5], pressures: [6e6, 10e6]}\n")();
  std::vector<double> oscillating;
  for (const Mode& mode : report.found.modes)
    if (mode.kind == ModeKind::oscillating) oscillating.push_back(std::abs(mode.s));
  check_rates(oscillating, {std::sqrt(B / m * (A1 * A1 / V1 + A2 * A2 / V2))}, 1e-4);
}

TEST_CASE("a free superelement has the frequencies of its matrices", "[linearised]") {
  const BeamSuperelement beam = straight_beam({}, 6).reduced();
  TemporaryFolder folder;
  write_superelement(beam.body, folder / "beam.h5");
  const ModesReport report =
      ModesOf("elements: {rod: {type: superelement, file: " + folder.path() + "/beam.h5}}\n")({.count = 6});
  CHECK(count_rigid(report) == 6);
  const auto exact = bielle::symmetric_eigenpairs(beam.body.stiffness, beam.body.mass);
  REQUIRE(exact);
  std::vector<double> expected;
  for (int k = 6; k < 12; ++k) expected.push_back(std::sqrt(exact->values[k]));
  check_rates(rates_of(report), expected, 1e-9);
}

TEST_CASE("the analysis records frequencies, shapes and shares of energy", "[linearised]") {
  ModesOf model(
      "gravity: [0, 0, -9.81]\n"
      "nodes: {a: {position: [0, 0, 0], fixed: true}, b: {position: [1, 0, 0]}}\n"
      "elements: {b: {type: beam, nodes: [a, b], elements: 4, section: {circle: 0.01, young: 2e11, poisson: 0.3, "
      "density: 7800}}, "
      "tip: {type: point_mass, node: b, mass: 3}}\n"
      "analysis: [{type: static}, {type: eigen, count: 3}, {type: eigen, count: 2, shapes: false}]\n");
  MemorySink sink(model.file.model);
  Session session(model.file.model);
  session.add_sink(sink);
  AnalysisSummary summary;
  for (const auto& analysis : model.file.analyses) {
    summary = analysis->run(session);
    if (&analysis == &model.file.analyses[1]) {
      CHECK(summary.numbers.at("frequency").size() == 3);
      CHECK_THAT(summary.text, Catch::Contains("eigen, 3 modes") && Catch::Contains("element 'tip'"));
      CHECK_THAT(summary.text, !Catch::Contains("not in equilibrium"));
    }
  }
  const std::vector<double> frequency = sink.read(1, "eigen/frequency");
  REQUIRE(frequency.size() == 3);
  const std::vector<double> share = sink.read(1, "eigen/energy_share"), shapes = sink.read(1, "eigen/displacement");
  REQUIRE(share.size() == 3 * 2);
  for (std::size_t k = 0; k < 3; ++k) CHECK(share[2 * k] + share[2 * k + 1] == Approx(1).epsilon(1e-12));
  // Kinetic and potential energy are the same over a period.
  const std::vector<double> kinetic = sink.read(1, "eigen/kinetic_energy"),
                            potential = sink.read(1, "eigen/potential_energy");
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(kinetic[2 * k] + kinetic[2 * k + 1] == Approx(potential[2 * k] + potential[2 * k + 1]).epsilon(1e-6));
  const std::size_t nodes = model.file.model.nodes().size();
  CHECK(shapes.size() == 3 * nodes * 3 * 2);
  double most = 0;
  for (std::size_t k = 0; k < nodes * 6; ++k) most = std::max(most, std::abs(shapes[k]));
  CHECK(most == Approx(1).epsilon(0.5));  // 1 m, unless rotations are larger
  CHECK_THROWS(sink.read(2, "eigen/displacement"));
  CHECK(sink.read(2, "eigen/frequency").size() == 2);
}

TEST_CASE("a junction without volume has no mode of its own: two lines in series are one", "[linearised]") {
  const auto circuit = [](const std::string& lines) {
    return "nodes: {mass: {position: [0, 0, 1], fixed: [x, y, rx, ry, rz]}}\n"
           "elements:\n  load: {type: point_mass, node: mass, mass: 500}\n"
           "  jack: {type: hydraulic_actuator, nodes: [ground, mass], piston_areas: [2e-3, 1.2e-3], "
           "dead_volumes: [1e-3, 0.2e-3], stroke: [1, 1.5], ports: [a, b]}\n"
           "hydraulics:\n  ambient_pressure: 0\n  fluid: {density: 850, bulk_modulus: 1.4e9, viscosity: 0.03}\n"
           "  volumes: {a: {volume: 1e-4, pressure: 6e6}, b: {volume: 1e-4, pressure: 10e6}, c: {volume: 5e-3, "
           "pressure: 6e6}}\n" +
           lines;
  };
  const ModesReport through = ModesOf(circuit(
      "  junctions: [j]\n  lines: {l: {from: a, to: j, laminar: {conductance: 4e-11}}, k: {from: j, to: c, laminar: "
      "{conductance: 4e-11}}}\n"))();
  const ModesReport direct = ModesOf(circuit("  lines: {l: {from: a, to: c, laminar: {conductance: 2e-11}}}\n"))();
  CHECK(through.found.all);
  REQUIRE(through.found.modes.size() == direct.found.modes.size());
  CHECK(count_rigid(through) == count_rigid(direct));
  bool damped = false;
  for (std::size_t k = 0; k < direct.found.modes.size(); ++k) {
    const std::complex<double> s = direct.found.modes[k].s;
    CHECK(std::abs(through.found.modes[k].s - s) <= 1e-9 * std::abs(s));
    if (s.imag() != 0 && s.real() < -1e-4 * std::abs(s)) damped = true;
  }
  CHECK(damped);
}
