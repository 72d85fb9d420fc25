// Frequency responses as sums over modes against direct ones: symmetric, damped, gyroscopic and non-symmetric
// equations.
#include <cmath>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/solvers/linearised/equation_products.hpp"
#include "mechanism/solvers/linearised/modal_poles.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Complex = std::complex<double>;

namespace test_superposition {
namespace {

/// A beam on two supports with a weight that hangs from it, damped; a moment and a force drive it.
const std::string frame =
    "gravity: [0, 0, -9.81]\n"
    "nodes:\n  a: {position: [0, 0, 0], fixed: true}\n  m: {position: [1, 0, 0]}\n  b: {position: [2, 0, 0], fixed: "
    "[y, z]}\n"
    "  bob: {position: [1, 0, -0.4]}\n"
    "elements:\n"
    "  left: {type: beam, nodes: [a, m], elements: 8, orientation: [0, 1, 0], section: {rectangle: [0.03, 0.02], "
    "young: "
    "2.1e11, poisson: 0.3, density: 7850}, damping: 1e-5}\n"
    "  right: {type: beam, nodes: [m, b], elements: 8, orientation: [0, 1, 0], section: {rectangle: [0.03, 0.02], "
    "young: "
    "2.1e11, poisson: 0.3, density: 7850}, damping: 1e-5}\n"
    "  bob: {type: rigid_body, node: bob, mass: 3, inertia: [0.01, 0.01, 0.01]}\n"
    "joints: {pivot: {type: spherical, nodes: [m, bob], position: [1, 0, 0]}}\n"
    "measures: {bears: pivot.reaction.z, speed: bob.velocity.x}\n";

/// Returns a spinning disc on an elastic mast, with a controller that pushes across it: gyroscopic, and not symmetric.
std::string rotor(double speed, double across) {
  return fmt::format(
      "nodes: {{foot: {{position: [0, 0, 0], fixed: true}}, head: {{position: [0, 0, 1]}}, disc: {{position: [0, 0, "
      "1.1], "
      "angular_velocity: [0, 0, {0}]}}}}\n"
      "elements:\n"
      "  mast: {{type: beam, nodes: [foot, head], elements: 10, orientation: [1, 0, 0], section: {{rectangle: [0.03, "
      "0.02], young: 2.1e11, poisson: 0.3, density: 7850}}, damping: 2e-5}}\n"
      "  disc: {{type: rigid_body, node: disc, solid: {{cylinder: [0.25, 0.02], density: 7850}}}}\n"
      "joints: {{bearing: {{type: hinge, nodes: [head, disc], position: [0, 0, 1.05], axis: [0, 0, 1]}}}}\n"
      "loads: {{seal: {{node: head, force: [\"-{1}*y\", \"{1}*x\", 0]}}}}\n"
      "measures: {{x: head.position.x, y: head.position.y}}\n",
      speed, across);
}

FrequencyResponseOptions asked(const ModesOf& model, const std::string& in, const std::string& out,
                               const std::vector<std::string>& measures, double to) {
  FrequencyResponseOptions options;
  const auto node = [&](const std::string& name) { return *model.file.model.find_node(name); };
  options.inputs = {{"force", node(in), false, Vector3::UnitX()}, {"side", node(in), false, Vector3(0, 0.6, 0.8)}};
  options.outputs = {{"moves", node(out), false, Vector3::UnitX()}, {"turns", node(out), true, Vector3::UnitY()}};
  for (const std::string& measure : measures) options.outputs.push_back({measure, -1, false, {}});
  for (int k = 0; k < 150; ++k) options.frequencies.push_back(0.3 + to * k / 149);
  return options;
}

/// Returns the largest deviation of the sum from the direct answer, relative to the latter's mean size.
double deviation(const ModesOf& model, FrequencyResponseOptions options, int modes, double& told) {
  const FrequencyResponse direct = compute_frequency_response(model.session, options);
  options.modes = modes;
  const FrequencyResponse sum = compute_frequency_response(model.session, options);
  told = sum.modal->deviation;
  double worst = 0;
  for (Eigen::Index i = 0; i < direct.response[0].rows(); ++i)
    for (Eigen::Index j = 0; j < direct.response[0].cols(); ++j) {
      double size = 0;
      for (const Eigen::MatrixXcd& H : direct.response) size += std::abs(H(i, j)) / direct.response.size();
      for (std::size_t f = 0; f < direct.response.size(); ++f)
        worst = std::max(worst, std::abs(sum.response[f](i, j) - direct.response[f](i, j)) / size);
    }
  return worst;
}

}  // namespace

TEST_CASE("a sum over modes with the residual of the others is the direct answer, more closely with more modes",
          "[linearised]") {
  const ModesOf hanging(frame, true), spinning(rotor(200, 0)), pushed(rotor(200, 3e3));
  struct Case {
    const ModesOf& model;
    FrequencyResponseOptions options;
    int few, many;
  };
  for (const Case& each : {Case{hanging, asked(hanging, "m", "bob", {"bears", "speed"}, 100), 8, 14},
                           Case{spinning, asked(spinning, "head", "head", {"x"}, 150), 7, 14},
                           Case{pushed, asked(pushed, "head", "disc", {"y"}, 150), 7, 14}}) {
    double told_few = 0, told_many = 0;
    const double few = deviation(each.model, each.options, each.few, told_few),
                 many = deviation(each.model, each.options, each.many, told_many);
    CAPTURE(few, many, told_few, told_many);
    CHECK(few < 0.05);
    CHECK(many < 1e-4);
    constexpr double rounding = 1e-5;  // relative to the direct answers: reactions of stiff parts
    CHECK((many < few || few < rounding));
    CHECK(told_many < 1e-3);
  }
}

TEST_CASE("left and right vectors of small motions are biorthogonal, of symmetric and other equations",
          "[linearised]") {
  for (const std::string& text : {frame, rotor(200, 0), rotor(200, 3e3)}) {
    const ModesOf model(text, text == frame);
    const ModesReport report = model({.count = 12});
    const LinearisedEquations& equations = *report.equations;
    const std::vector<ModalPole> poles = modal_poles(equations, report.found.modes);
    CHECK(poles.size() + static_cast<std::size_t>(count_rigid(report)) == report.found.modes.size());
    for (std::size_t i = 0; i < poles.size(); ++i)
      for (std::size_t j = 0; j < poles.size(); ++j) {
        // y_i^T (D(s_i) - D(s_j)) v_j / (s_i - s_j): 0, and 1 in the limit.
        const Complex si = poles[i].s, sj = i == j ? si * (1 + 1e-5) : poles[j].s;
        if (i != j && std::abs(si - sj) < 1e-6 * std::abs(si)) continue;
        const Eigen::VectorXcd change =
            equations_times(equations, si, poles[j].right) - equations_times(equations, sj, poles[j].right);
        const Complex pairing = (poles[i].left.transpose() * change)(0) / (si - sj);
        CAPTURE(i, j, si, sj);
        const double terms = poles[i].left.norm() * change.norm() / std::abs(si - sj);
        if (i == j)
          CHECK(std::abs(pairing - 1.0) < 1e-4);
        else
          CHECK(std::abs(pairing) < 1e-6 * terms);
      }
  }
}

TEST_CASE("sums over modes are complete if damped modes have equal eigenvalues", "[linearised]") {
  // A round cantilever that is drawn obliquely: each bending mode occurs twice, with arbitrary shapes.
  const ModesOf round(
      "nodes: {foot: {position: [0, 0, 0], fixed: true}, tip: {position: [0.36, 0.48, 0.8]}}\n"
      "elements: {mast: {type: beam, nodes: [foot, tip], elements: 4, section: {circle: 0.02, young: 2.1e11, poisson: "
      "0.3, density: 7850}, damping: 1e-4}}\n");
  double told = 0;
  CHECK(deviation(round, asked(round, "tip", "tip", {}, 100), 14, told) < 1e-4);
}

TEST_CASE("sums over modes notice that a stiffness is slightly unsymmetric", "[linearised]") {
  // 1 N/m next to 1e4 N/m: the motion of the disc across the force on the mast follows from it alone.
  const ModesOf pushed(rotor(0, 1));
  double told = 0;
  CHECK(deviation(pushed, asked(pushed, "head", "disc", {"y"}, 100), 14, told) < 1e-4);
}

TEST_CASE("sums over modes are refused where they mean nothing", "[linearised]") {
  // A free body: the rigid motion makes up half of the response.
  const ModesOf free(
      "nodes: {a: {position: [0, 0, 0], fixed: [y, z, rx, ry, rz]}, b: {position: [1, 0, 0], fixed: [y, z, rx, ry, "
      "rz]}}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 2}\n  b: {type: point_mass, node: b, mass: 1}\n"
      "  s: {type: spring_damper, nodes: [a, b], stiffness: 200, length: 1}\n");
  FrequencyResponseOptions options;
  const int a = *free.file.model.find_node("a");
  options.inputs = {{"force", a, false, Vector3::UnitX()}};
  options.outputs = {{"moves", a, false, Vector3::UnitX()}};
  options.frequencies = {0.1, 1};
  options.modes = 2;
  CHECK_THROWS_WITH(compute_frequency_response(free.session, options),
                    Catch::Contains("a rigid mode that no force resists"));
  // With critical damping, a double eigenvalue has only one shape.
  const ModesOf critical(
      "nodes: {a: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 2}\n"
      "  s: {type: spring_damper, nodes: [ground, a], stiffness: 200, damping: 40}\n");
  options.inputs[0].node = options.outputs[0].node = *critical.file.model.find_node("a");
  CHECK_THROWS_WITH(compute_frequency_response(critical.session, options), Catch::Contains("defective"));
  // With 1 + 1e-13 of it, the eigenvalues differ by 9e-7 of themselves, and their parts cancel to 1e-7.
  const ModesOf nearly(
      "nodes: {a: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 2}\n"
      "  s: {type: spring_damper, nodes: [ground, a], stiffness: 200, damping: 40.000000000004}\n");
  options.inputs[0].node = options.outputs[0].node = *nearly.file.model.find_node("a");
  CHECK_THROWS_WITH(compute_frequency_response(nearly.session, options), Catch::Contains("nearly so"));
}

TEST_CASE("the analysis `frequency_response` with `modes` says how good it is", "[linearised]") {
  const MechanismFile file = read_mechanism_text(
      frame +
          "analysis: [{type: static}, {type: frequency_response, inputs: [{node: m, direction: z}], outputs: [{node: "
          "m, direction: z}], frequencies: {from: 1, to: 80}, modes: 10}]\n",
      "model.yaml");
  Session session(file.model);
  MemorySink sink(file.model);
  session.add_sink(sink);
  file.analyses[0]->run(session);
  const AnalysisSummary summary = file.analyses[1]->run(session);
  CHECK_THAT(summary.text, Catch::Contains("by 10 modes up to") && Catch::Contains("residual of the others"));
  CHECK(summary.numbers.at("deviation").at(0) == sink.read(1, "frequency_response/deviation").at(0));
  CHECK(summary.numbers.at("deviation")[0] < 1e-3);
  CHECK_THAT(summary.text, !Catch::Contains("warning:"));
}

TEST_CASE("a sum over too few modes gives a warning, and one at 0 Hz alone is refused where it stands",
          "[linearised]") {
  const auto text = [](const std::string& frequencies) {
    return frame +
           "analysis: [{type: static}, {type: frequency_response, inputs: [{node: m, direction: z}], outputs: [{node: "
           "m, "
           "direction: z}], frequencies: " +
           frequencies + ", modes: 1}]\n";
  };
  const MechanismFile file = read_mechanism_text(text("{from: 1, to: 300}"), "model.yaml");
  Session session(file.model);
  file.analyses[0]->run(session);
  const AnalysisSummary summary = file.analyses[1]->run(session);
  CHECK(summary.numbers.at("deviation")[0] > 0.05);
  CHECK_THAT(summary.text, Catch::Contains("warning:"));
  CHECK_THROWS_WITH(
      read_mechanism_text(text("[0]"), "model.yaml"),
      Catch::StartsWith("model.yaml:") && Catch::Contains("modes: a sum over modes is for frequencies above 0"));
}

}  // namespace test_superposition
