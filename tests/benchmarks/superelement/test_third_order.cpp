// Superelements of beams against the same geometrically exact beam: the error of their linear elasticity.
//
// Section of 1 x 1, E = 1e7, without shear; length 5 pi, straight or an arc of 9 degrees. Both models have the same
// flexibility, so that their difference, without the part linear in the load, is that of large deformation.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/superelement/solid_bars.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_third_order {
namespace {

constexpr double EI = 1e7 / 12, GJ = 7.03e5, floor_of_residual = 1e-6;

BeamChain chain_of(const BarAxis& axis, double length, double EA, int modes) {
  BeamChain chain;
  constexpr int elements =
      48;  // the stress of the free body is constant in each: what that costs falls with their square
  for (int k = 0; k <= elements; ++k) chain.nodes.push_back(axis.point(length * k / elements));
  chain.properties = {1, EA, EI, EI, GJ, 0.1};
  chain.interfaces = {{0}, {elements}};
  chain.modes = modes;
  return chain;
}

/// Interface names of these bodies are a and b: those of the bars' texts are root and tip.
void write_bar(Superelement body, const std::string& path) {
  body.interfaces[0].name = "root";
  body.interfaces[1].name = "tip";
  write_superelement(body, path);
}

/// Displacement, and rotation times the length, of a node under the model's loads.
Vector6 answer(const std::string& text, const std::string& node, double length) {
  StaticModel model(text);
  const NodeState start = model.node(node);
  REQUIRE(model.load(3, floor_of_residual) >= 0);
  Vector6 result;
  result << model.node(node).x - start.x, length * log_so3(start.R.transpose() * model.node(node).R);
  return result;
}

}  // namespace

TEST_CASE("loads on one superelement: its error is of third order") {
  struct Load {
    std::string name;
    Vector3 force, moment;
  };
  const Vector3 none = Vector3::Zero();
  const std::vector<Load> loads = {{"tension", {3e3, 0, 60}, none},
                                   {"compression", {-1e3, 0, 60}, none},
                                   {"shear", {0, 0, 600}, none},
                                   {"shear both ways", {0, 400, 600}, none},
                                   {"bending", none, {0, 2e4, 0}},
                                   {"bending in the plane", none, {0, 0, 2e4}},
                                   {"bending both ways", none, {0, 1.5e4, 1.5e4}},
                                   {"torsion", none, {1.2e4, 0, 0}},
                                   {"torsion and bending", none, {1e4, 2e4, 0}},
                                   {"torsion and shear", {0, 0, 600}, {1e4, 0, 0}},
                                   {"shear and bending", {0, 0, 600}, {0, 0, 1e4}},
                                   {"all", {1500, 300, 500}, {8e3, -1.2e4, 1e4}}};
  const double length = 5 * M_PI, EA = 1e7;
  TemporaryFolder folder;
  for (const double radius : {0.0, 100.0}) {
    const SolidBar bar{{radius}, length};
    write_bar(chain_of(bar.axis, length, EA, 16).reduced().body, folder / "piece.h5");
    const std::string element = chain_of_pieces(bar, 1, folder.path() + "/piece.h5"),
                      beam = exact_beam(
                          bar.axis, length,
                          fmt::format("{{EA: {0}, GAy: 1e10, GAz: 1e10, GJ: {1}, EIy: {2}, EIz: {2}}}", EA, GJ, EI),
                          48);
    for (const Load& load : loads) {
      CAPTURE(radius, load.name);
      const auto answers = [&](double factor) {
        const Vector3 F = factor * load.force, M = factor * load.moment;
        const Vector6 exact = answer(beam + tip_load("tip", F, M), "tip", length);
        return std::pair(Vector6(answer(element + tip_load("n1", F, M), "n1", length) - exact), exact);
      };
      constexpr double small = 1e-3;
      const Vector6 linear = answers(small).first / small;
      const auto error = [&](double factor) {
        const auto [difference, exact] = answers(factor);
        return (difference - factor * linear).norm() / exact.norm();
      };
      const double full = error(1), half = error(0.5);
      CHECK(full < 6e-4);
      CHECK(half < 0.3 * full + 2.5e-5);  // the last for the elements of the free body's stress
    }
  }
}

TEST_CASE("Euler's load of a pinned bar of one, two and four superelements") {
  // pi^2 EI / L^2: P / EA = 3e-5 of it.
  const double L = 16, EA = 1e9, euler = M_PI * M_PI * EI / (L * L);
  TemporaryFolder folder;
  for (const int pieces : {1, 2, 4}) {
    CAPTURE(pieces);
    const SolidBar bar{{}, L / pieces};
    write_bar(chain_of(bar.axis, L / pieces, EA, 8).reduced().body, folder / "piece.h5");
    const std::string node = fmt::format("n{}", pieces);
    StaticModel model(chain_of_pieces(bar, pieces, folder.path() + "/piece.h5") +
                      tip_load(node, {-euler, 0, 0}, Vector3::Zero()));
    // The text holds n0; its rotation about z is free, and the tip moves along x alone and turns about z.
    for (const int direction : {1, 2, 3, 4}) model.hold(node, direction);
    model.free.push_back(model.unknown("n0", 5));
    CHECK(model.critical_load(0.8, 0.05, 1e-4, 1e-6) == Approx(1).epsilon(1e-3));
  }
}

}  // namespace test_third_order
