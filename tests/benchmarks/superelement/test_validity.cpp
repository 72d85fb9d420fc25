// The estimate of the error of a superelement's linear elasticity, against the geometrically exact beam.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/run_analyses.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/benchmarks/superelement/solid_bars.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_validity {
namespace {

constexpr double EI = 1e7 / 12, GJ = 7.03e5, EA = 1e8, length = 16;
const std::string section = fmt::format("{{EA: {0}, GAy: 1e10, GAz: 1e10, GJ: {1}, EIy: {2}, EIz: {2}}}", EA, GJ, EI);

/// Returns the estimated error of the model's superelement, at its static equilibrium.
double estimate_of(const std::string& text) {
  const ReadyModel model(text);
  Environment environment = model.environment();
  environment.statics = true;
  State state = model.system.start(0);
  solve_statics(model.system, environment, LoadSteps(4), NewtonOptions{}, state);
  const auto gatherer = model.file.model.members()[0].component->make_step_recorder();
  gatherer->begin();
  gatherer->add(LocalState(state, model.system.slots()[0], environment));
  return gatherer->results()[0].values[0];
}

/// Returns the bar as a chain of beam elements with a mesh.
BeamSuperelement bar_with(const BarAxis& axis, const std::vector<BeamInterface>& interfaces, int elements = 48) {
  BeamChain chain;
  for (int k = 0; k <= elements; ++k) chain.nodes.push_back(axis.point(length * k / elements));
  chain.properties = {1, EA, EI, EI, GJ, 0.1};
  chain.interfaces = interfaces;
  chain.modes = 12;
  BeamSuperelement reduced = chain.reduced();
  add_mesh(chain, 0.5, reduced);
  return reduced;
}

/// Returns the displacements of a node at static equilibrium.
Vector3 moved(const std::string& text, const std::string& node) {
  const ReadyModel model(text);
  Environment environment = model.environment();
  environment.statics = true;
  State state = model.system.start(0);
  const Vector3 start = model.node(state, node).x;
  solve_statics(model.system, environment, LoadSteps(8), NewtonOptions{}, state);
  return model.node(state, node).x - start;
}

}  // namespace

TEST_CASE("a superelement says how wrong it is where interfaces have no rotations, and where it bends in its modes") {
  TemporaryFolder folder;
  constexpr int elements = 48;
  constexpr std::array<bool, 6> forces = {true, true, true, false, false, false},
                                hinge = {true, true, true, true, false, true};
  struct Case {
    std::string name;
    std::vector<BeamInterface> interfaces;
    std::string root, tip;  ///< keys that hold the nodes
    std::string node;       ///< observed node: m in the middle, e at the end, b at the interface there
    double weight;          ///< weight by gravity; 0: a force on the tip
  };
  const std::string slides = ", fixed: [y, z, rx, ry, rz]";
  const double unit = EI / (length * length);
  const std::string heavy =
      section.substr(0, section.size() - 1) + ", mass_per_length: 1, Jx: 0.1, Jy: 0.05, Jz: 0.05}";
  for (const Case& c : {Case{"force on a tip without rotations", {{0}, {elements, forces}}, "fixed: true", "", "b", 0},
                        Case{"force on a hinged tip", {{0}, {elements, hinge}}, "fixed: true", "", "b", 0},
                        Case{"held at the root alone", {{0}}, "fixed: true", "", "e", 2.7},
                        Case{"ends that approach each other", {{0}, {elements}}, "fixed: true", slides, "m", 43}}) {
    write_superelement(bar_with({}, c.interfaces).body, folder / "bar.h5");
    const bool two = c.interfaces.size() > 1;
    const std::string element = fmt::format(
        "nodes: {{a: {{{}}}{}}}\nelements: {{it: {{type: superelement, file: {}/bar.h5, nodes: {{a: a{}}}}}}}\n"
        "points: {{m: {{element: it, at: [8, 0, 0]}}, e: {{element: it, at: [16, 0, 0]}}}}\n",
        c.root, two ? ", b: {position: [16, 0, 0]" + c.tip + "}" : "", folder.path(), two ? ", b: b" : "");
    const std::string beam = fmt::format(
        "nodes: {{a: {{{0}}}, m: {{position: [8, 0, 0]}}, e: {{position: [16, 0, 0]{1}}}}}\n"
        "elements: {{p: {{type: beam, nodes: [a, m], elements: 24, section: {2}}}, q: {{type: beam, nodes: [m, e], "
        "elements: 24, "
        "section: {2}}}}}\n",
        c.root, c.tip, heavy);
    const auto loaded = [&](const std::string& text, const std::string& tip, double f) {
      return text + (c.weight == 0 ? tip_load(tip, {0, 0, f * unit}, Vector3::Zero())
                                   : fmt::format("gravity: [0, 0, {:.17g}]\n", c.weight * f * unit / length));
    };
    for (const double factor : {0.15, 0.3, 0.63}) {  // off by 5, 10, 20 % of the length
      const auto of_element = [&](double f) { return moved(loaded(element, "b", f), c.node); };
      const auto of_beam = [&](double f) { return moved(loaded(beam, "e", f), c.node == "b" ? "e" : c.node); };
      const Vector3 exact = of_beam(factor), linear = (of_element(1e-3) - of_beam(1e-3)) / 1e-3;
      const double error = (of_element(factor) - exact - factor * linear).norm() / exact.norm();
      const double estimate = estimate_of(loaded(element, "b", factor)), bend = exact.norm() / length;
      CAPTURE(c.name, factor, bend, error, estimate, estimate / error);
      CHECK(estimate > error / 3);
      CHECK(estimate < 3 * error);
    }
  }
}

TEST_CASE("a superelement says how wrong its deformation is") {
  TemporaryFolder folder;
  for (const double radius : {0.0, 100.0, 20.0}) {
    const BarAxis axis{radius};
    BeamChain chain;
    constexpr int elements = 96;
    for (int k = 0; k <= elements; ++k) chain.nodes.push_back(axis.point(length * k / elements));
    chain.properties = {1, EA, EI, EI, GJ, 0.1};
    chain.interfaces = {{0}, {elements}};
    chain.modes = 12;
    Superelement body = chain.reduced().body;
    body.interfaces[0].name = "root";
    body.interfaces[1].name = "tip";
    write_superelement(body, folder / "piece.h5");
    const SolidBar bar{axis, length};
    const std::string element = chain_of_pieces(bar, 1, folder.path() + "/piece.h5"),
                      beam = exact_beam(axis, length, section, 64);
    const double unit = EI / (length * length);
    struct Load {
      Vector3 force, moment;
      bool forces_alone;
    };
    const Vector3 none = Vector3::Zero();
    for (const Load& load : {Load{{0, 0, unit}, none, true},
                             {{0, -unit, 0}, none, true},
                             {{0, unit, unit}, none, true},
                             {none, {0, unit * length / 1.5, 0}, false},
                             {{0, 0, unit}, {unit * length / 2, 0, 0}, false}})
      for (const double factor : {0.15, 0.3, 0.63}) {  // off by 5, 10, 20 % of the length
        const auto tip_of = [&](const std::string& text, const std::string& node, double f) -> Vector3 {
          StaticModel model(text + tip_load(node, f * load.force, f * load.moment));
          const Vector3 start = model.node(node).x;
          REQUIRE(model.load(6, 1e-3) >= 0);
          return model.node(node).x - start;
        };
        // The part that is linear in the load is that of the chain's elements.
        const Vector3 linear = (tip_of(element, "n1", 1e-3) - tip_of(beam, "tip", 1e-3)) / 1e-3;
        const Vector3 exact = tip_of(beam, "tip", factor);
        const double error = (tip_of(element, "n1", factor) - exact - factor * linear).norm() / exact.norm();
        const double estimate = estimate_of(element + tip_load("n1", factor * load.force, factor * load.moment));
        CAPTURE(radius, load.force.transpose(), load.moment.transpose(), factor, error, estimate);
        CHECK(estimate > 0.75 * error);  // the estimate is nowhere much too small
        if (load.forces_alone) CHECK(estimate < 3 * error);
      }
  }
}

TEST_CASE("a run that bends a superelement too far says so, and fails where it must") {
  TemporaryFolder folder;
  BeamChain chain = straight_beam({1, 1e5, 1.3, 1, 0.8, 1e-4}, 6);
  write_superelement(chain.reduced().body, folder / "beam.h5");
  const auto session_of = [&](double moment, const std::string& keys) {
    return fmt::format(
        "nodes: {{a: {{fixed: true}}, b: {{position: [1, 0, 0]}}}}\nelements: {{rod: {{type: superelement, file: "
        "{}/beam.h5, "
        "nodes: {{a: a, b: b}}{}}}}}\nloads: {{m: {{node: b, moment: [0, 0, {}]}}}}\nanalysis: [{{type: static, steps: "
        "10}}]\n",
        folder.path(), keys, moment);
  };
  const auto summary_of = [&](double moment, const std::string& keys) {
    const MechanismFile file = read_mechanism_text(session_of(moment, keys), "model.yaml");
    Progress quiet(true);
    return run_analyses(file, folder / "results.h5", quiet)[0].text;
  };
  using Catch::Contains;
  CHECK_THAT(summary_of(0.3, ""), !Contains("wrong by"));
  CHECK_THAT(summary_of(0.5, ""),
             Contains("  superelement 'rod' bends by 0.5 rad between its interfaces at load factor 1: its "
                      "deformation is wrong by about 0.2 %\n"));
  CHECK_THAT(summary_of(1, ""), Contains("warning: superelement 'rod'") && Contains("; cut it into pieces\n"));
  CHECK_THROWS_WITH(
      summary_of(1, ", largest_error: 2e-3"),
      Contains("load factor 0.6: superelement 'rod' bends by 0.6") && Contains("more than its `largest_error`, 0.002"));
}

}  // namespace test_validity
