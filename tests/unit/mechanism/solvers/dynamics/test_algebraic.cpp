// First-order unknowns whose equations contain no rates, compared with closed forms and their elimination: the start,
// statics and paths. (Time integration: tests/order/test_algebraic_unknown.cpp.)
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/statics/arc_length.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/orifices_in_series.hpp"
#include "tests/support/scalar_equation.hpp"
#include "tests/support/series_strut.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::message_of;
using bielle::test::OrificesInSeries;
using bielle::test::ScalarEquation;
using bielle::test::SeriesStrut;
using Catch::Contains;
using Catch::Matchers::WithinRel;

namespace {

struct Ready {
  MechanismFile file;
  std::unique_ptr<System> system;
  explicit Ready(const std::string& text) : file(read_mechanism_text(text, "model.yaml")) {}
  int node(const std::string& name) const { return *file.model.find_node(name); }
  void add(std::unique_ptr<Component> component, Recorded recorded = Recorded::no) {
    const Entry entry{Section::elements, component->name()};
    file.model.add(std::move(component), entry, recorded);
  }
  const System& ready() {
    system = std::make_unique<System>(file.model);
    return *system;
  }
  const Environment& environment() const { return file.model.environment; }
};

const char* const mass_alone = R"yaml(
nodes: {mass: {position: [0, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 1, inertia: [1, 1, 1]}}
)yaml";

constexpr SeriesStrut::Law law{400, 3e4, 900, 5, 0.7};

/// Returns a pendulum whose bob hangs on a strut as well.
Ready pendulum(bool eliminated, double start = 0) {
  Ready model(R"yaml(
gravity: [0, -9.81, 0]
nodes: {anchor: {position: [0.9, 0.7, 0], fixed: true}, bob: {position: [0.8, 0, 0], velocity: [0, 1.6, 0], angular_velocity: [0, 0, 2]}}
elements: {bob: {type: rigid_body, node: bob, mass: 2, inertia: [0.05, 0.05, 0.05]}}
joints: {pivot: {type: spherical, nodes: [ground, bob], position: [0, 0, 0]}}
)yaml");
  model.add(std::make_unique<SeriesStrut>("strut", model.node("anchor"), model.node("bob"), law, eliminated, start));
  return model;
}

}  // namespace

TEST_CASE("algebraic unknowns start where their equations hold, with accelerations and reactions that go with them") {
  Ready eliminated = pendulum(true);
  State expected = eliminated.ready().start(0);
  make_consistent(*eliminated.system, eliminated.environment(), expected);
  const NodeState &anchor = expected.nodes[1], &bob = expected.nodes[2];
  const Vector3 s = bob.x - anchor.x;
  const double y = law.solve(s.norm(), s.normalized().dot(bob.v));
  for (const double guess : {0.0, 0.3, -5.0}) {
    CAPTURE(guess);
    Ready model = pendulum(false, guess);
    State state = model.ready().start(0);
    make_consistent(*model.system, model.environment(), state);
    CHECK_THAT(state.first_order[0], WithinRel(y, 1e-12));
    CHECK(state.first_order_rate[0] == 0);
    CHECK((state.nodes[2].a - bob.a).norm() < 1e-12 * bob.a.norm());
    CHECK((state.multiplier - expected.multiplier).norm() < 1e-12 * expected.multiplier.norm());
  }
}

TEST_CASE("the start finds a junction's pressure from far off, and the rates of others that depend on it") {
  const OrificesInSeries::Law orifices{1e-12, 1e-7, 2e-7, 1e2};
  constexpr double p = 1e7;
  // s_0 changes the flow by (s_0/s)^2/4.
  constexpr double rounding = 1e-9;
  for (const double guess : {0.0, 1e7, 9e7, -3e7, 2e6}) {
    CAPTURE(guess);
    Ready model(mass_alone);
    model.add(std::make_unique<OrificesInSeries>("chamber", orifices, p, guess), Recorded::alone);
    State state = model.ready().start(0);
    make_consistent(*model.system, model.environment(), state);
    CHECK(state.first_order[0] == p);
    CHECK_THAT(state.first_order[1], WithinRel(p / 5, rounding));
    CHECK_THAT(state.first_order_rate[0], WithinRel(-2e-7 / std::sqrt(5.0) * std::sqrt(p) / 1e-12, rounding));
  }
}

TEST_CASE("an algebraic unknown without a solution is named, and so is one that its equation does not determine") {
  const auto start = [](const ScalarEquation::Law (*equation)(double)) {
    Ready model(mass_alone);
    const Declaration::Scalar unknown{"pressure", "Pa", 1.5, ConstraintKind::holonomic, 1, "m^3/s", true};
    model.add(std::make_unique<ScalarEquation>("tee", unknown, [=](double y, double) { return equation(y); }),
              Recorded::alone);
    State state = model.ready().start(0);
    make_consistent(*model.system, model.environment(), state);
  };
  const std::string none = message_of<ComputationError>([&] {
    start([](double y) -> const ScalarEquation::Law { return {y * y + 1, 2 * y, 0}; });
  });
  CHECK_THAT(none, Contains("no value was found for pressure of element 'tee'") && Contains("m^3/s are left"));
  const std::string any = message_of<ComputationError>([&] {
    start([](double) -> const ScalarEquation::Law { return {3, 0, 0}; });
  });
  CHECK_THAT(any, Contains("singular at pressure of element 'tee': no equation determines it there"));
}

TEST_CASE("an algebraic unknown without a scale is found from zero as well, however small it is") {
  for (const double root : {0.0, 1e-12, -1e12}) {
    CAPTURE(root);
    Ready model(mass_alone);
    const Declaration::Scalar unknown{"value", "m", 0, ConstraintKind::holonomic, 0, "", true};
    model.add(std::make_unique<ScalarEquation>("bend", unknown, [=](double y, double) -> ScalarEquation::Law {
      const double b = std::max(std::abs(root), 1e-300);
      return {std::sinh((y - root) / b), std::cosh((y - root) / b) / b, 0};
    }));
    State state = model.ready().start(0);
    make_consistent(*model.system, model.environment(), state);
    CHECK(std::abs(state.first_order[0] - root) <= 1e-14 * std::abs(root));
  }
}

TEST_CASE("statics find algebraic unknowns with the positions") {
  for (const bool eliminated : {false, true}) {
    Ready model(R"yaml(
gravity: [0, -9.81, 0]
nodes: {bob: {position: [0, -0.75, 0], fixed: [x, z, rx, ry, rz]}}
elements: {bob: {type: point_mass, node: bob, mass: 2}}
)yaml");
    model.add(std::make_unique<SeriesStrut>("strut", model.node("ground"), model.node("bob"), law, eliminated));
    State state = model.ready().start(0);
    solve_statics(*model.system, model.environment(), 3, NewtonOptions{}, state);
    const double l = -state.nodes[1].x.y(), y = law.solve(l, 0);
    // Newton's tolerance.
    CHECK_THAT(law.force(y), WithinRel(2 * 9.81, 1e-9));
    CHECK_THAT(law.k_2 * (l - law.l_0 - y), WithinRel(2 * 9.81, 1e-9));
    if (!eliminated) CHECK_THAT(state.first_order[0], WithinRel(y, 1e-9));
  }
}

TEST_CASE("a path past a limit point takes algebraic unknowns along") {
  // Von Mises' truss, see test_arc_length.cpp; its bars are two springs in series each.
  constexpr double b = 3, h = 1, EA = 7;
  const double L0 = std::hypot(b, h);
  Ready model(R"yaml(
nodes:
  left: {position: [-3, 0, 0], fixed: true}
  right: {position: [3, 0, 0], fixed: true}
  apex: {position: [0, 1, 0], fixed: [x, z, rx, ry, rz]}
loads: {p: {node: apex, force: [0, -0.2, 0]}}
)yaml");
  const SeriesStrut::Law half{3 * EA / L0, 0, 1.5 * EA / L0, 0, L0};
  for (const char* const side : {"left", "right"})
    model.add(std::make_unique<SeriesStrut>(side, model.node(side), model.node("apex"), half, false));
  State state = model.ready().start(0);
  ContinuationOptions options;
  options.end.node = model.node("apex");
  options.end.displacement = 2.2;
  double limit = 0;
  follow_by_continuation(*model.system, model.environment(), {}, options, NewtonOptions{}, state,
                         [&](const State& at, const PathPoint& point) {
                           const double w = h - at.nodes[3].x.y();
                           const double P = 2 * EA * (h - w) * (1 / std::hypot(b, h - w) - 1 / L0);
                           CHECK(std::abs(0.2 * point.load_factor - P) < 1e-9);
                           if (point.limit) limit = std::max(limit, point.load_factor);
                         });
  const double w = h - std::sqrt(std::pow(b * b * L0, 2.0 / 3) - b * b);
  CHECK_THAT(0.2 * limit, WithinRel(2 * EA * (h - w) * (1 / std::hypot(b, h - w) - 1 / L0), 1e-9));
}
