// Superelements that bend: against the geometrically exact beam of the same stiffness, and against closed forms.
//
// The 45-degree bend of K.-J. Bathe, S. Bolourchi, IJNME 14 (1979) 961, radius 100, section 1 x 1, E = 1e7, nu = 0,
// load 600 across its plane: the geometrically exact rod with the torsion constant of a square and 5/6 of the shear
// areas, by shooting (tests/references/bend_45.py).
#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/statics.hpp"
#include "tests/benchmarks/superelement/solid_bars.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

constexpr double floor_of_residual = 1e-5;  // EA epsilon |x| / L of the pieces is 1e-8 to 1e-7

/// Returns the displacement of a model's node under its loads.
Vector3 displacement(const std::string& model, const std::string& node, int steps) {
  StaticModel statics(model);
  const Vector3 start = statics.node(node).x;
  REQUIRE(statics.load(steps, floor_of_residual) >= 0);
  return statics.node(node).x - start;
}

/// Reduced pieces of a bar, with variants of their geometric stiffness.
struct Pieces {
  SolidBar bar;
  int count;
  Superelement body;
  TemporaryFolder folder;

  Pieces(const SolidBar& piece, int pieces) : bar(piece), count(pieces), body(bar.reduced()) {}
  Vector3 tip(const Superelement& variant, const Vector3& force, const Vector3& moment, int steps = 2) {
    write_superelement(variant, folder / "piece.h5");
    const std::string node = fmt::format("n{}", count);
    return displacement(chain_of_pieces(bar, count, folder.path() + "/piece.h5") + tip_load(node, force, moment), node,
                        steps);
  }
  Vector3 tip(const Vector3& force, const Vector3& moment, int steps = 2) { return tip(body, force, moment, steps); }
  Vector3 beam(const Vector3& force, const Vector3& moment, int elements = 64) const {
    return displacement(
        exact_beam(bar.axis, bar.length * count, bar.fitted_section(body), elements) + tip_load("tip", force, moment),
        "tip", 8);
  }
};

Pieces bend_of(int pieces) { return Pieces({BarAxis{100}, 25 * M_PI / pieces, 12, 120 / pieces}, pieces); }

const Vector3 none = Vector3::Zero();

}  // namespace

TEST_CASE("the 45-degree bend of superelements converges to the exact rod, in any number of load steps") {
  // The table's arc begins along y and turns to x; this one begins along x and turns to -y.
  const Vector3 tip = ReferenceTable("bend_45").vector("own.600"), load(0, 0, 600);
  const Vector3 exact(tip.y() - 50 * std::sqrt(2), -(tip.x() - 100 + 50 * std::sqrt(2)), tip.z());
  for (const auto& [pieces, tolerance] : {std::pair{3, 0.01}, {5, 0.005}, {10, 0.0025}}) {
    CAPTURE(pieces);
    Pieces bend = bend_of(pieces);
    const Vector3 u = bend.tip(load, none, 6);
    CHECK((u - exact).norm() < tolerance * exact.norm());
    CHECK((bend.tip(load, none, 1) - u).norm() < 1e-8 * exact.norm());
    CHECK((bend.tip(load, none, 17) - u).norm() < 1e-8 * exact.norm());
    if (pieces == 3) continue;
    // Compared with the beam of the same stiffness, the difference is that of large bending.
    const Vector3 reference = bend.beam(load, none);
    CHECK((u - reference).norm() < 5e-4 * reference.norm());
    // Without the geometric stiffness the result is wrong.
    Superelement without = bend.body;
    without.load_stiffness.clear();
    CHECK((bend.tip(without, load, none, 6) - reference).norm() > 1e-3 * reference.norm());
  }
}

TEST_CASE("an arc of superelements under a moment across its plane wants the geometric stiffness of moments") {
  Pieces bend = bend_of(5);
  const Vector3 moment(0, 1.5e4, 0), reference = bend.beam(none, moment);
  CHECK((bend.tip(none, moment) - reference).norm() < 5e-4 * reference.norm());
  Superelement without = bend.body;
  for (const std::size_t j : {3, 4, 5, 9, 10, 11}) without.load_stiffness[j].setZero();
  CHECK((bend.tip(without, none, moment) - reference).norm() > 1e-3 * reference.norm());
}

TEST_CASE("the bend of superelements under forces and moments that turn with its tip, and under those that do not") {
  Pieces bend = bend_of(5);
  write_superelement(bend.body, bend.folder / "piece.h5");
  const std::string pieces = chain_of_pieces(bend.bar, 5, bend.folder.path() + "/piece.h5"),
                    beam = exact_beam(bend.bar.axis, bend.bar.length * 5, bend.bar.fitted_section(bend.body), 64);
  struct Load {
    Vector3 force, moment;
  };
  for (const Load& load :
       {Load{{0, 0, 300}, none}, {none, {0, 1e4, 0}}, {none, {6e3, 8e3, 8e3}}, {{50, 0, 200}, {5e3, 5e3, -5e3}}}) {
    CAPTURE(load.force.transpose(), load.moment.transpose());
    Vector3 dead = none;
    for (const bool follower : {false, true}) {
      const auto text = [&](const std::string& node) {
        return fmt::format("loads: {{p: {{node: {}, force: {}, moment: {}, follower: {}}}}}\n", node, list(load.force),
                           list(load.moment), follower);
      };
      const Vector3 reference = displacement(beam + text("tip"), "tip", 8);
      CHECK((displacement(pieces + text("n5"), "n5", 3) - reference).norm() < 5e-4 * reference.norm());
      if (follower) CHECK((reference - dead).norm() > 0.01 * dead.norm());
      dead = reference;
    }
  }
}

TEST_CASE("a straight bar under two end moments is an arc of a circle, in any number of load steps of the program") {
  // 1 x 1 x 16, moments of 7500 about y and z: the circle of radius EI/M in the plane between them. Nothing excites the
  // modes of the other plane: their equations hold rounding.
  const SolidBar bar{{}, 16, 16, 24};
  TemporaryFolder folder;
  write_superelement(bar.reduced(), folder / "piece.h5");
  const double EI = 1e7 / 12, M = 7500 * std::sqrt(2.0), angle = 16 * M / EI, radius = EI / M;
  for (const int steps : {1, 5, 20}) {
    CAPTURE(steps);
    const ReadyModel model(chain_of_pieces(bar, 1, folder.path() + "/piece.h5") +
                           tip_load("n1", none, {0, 7500, 7500}));
    Environment environment = model.environment();
    environment.statics = true;
    State state = model.system.start(0);
    solve_statics(model.system, environment, LoadSteps(steps), NewtonOptions{}, state);
    const Vector3 u = model.node(state, "n1").x - Vector3(16, 0, 0);
    const double deflection = radius * (1 - std::cos(angle));
    // EI of the mesh is 3e-4 off; the element's error is of third order in 0.2 rad.
    CHECK(u.y() == Approx(deflection / std::sqrt(2.0)).epsilon(1e-3));
    CHECK(u.z() == Approx(-deflection / std::sqrt(2.0)).epsilon(1e-3));
    CHECK(u.x() == Approx(radius * std::sin(angle) - 16).epsilon(5e-3));
  }
}
