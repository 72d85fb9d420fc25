// One mechanism in micrometres, metres and kilometres: scaled by similarity, its motion is the same.
#include <Eigen/LU>
#include <Eigen/SVD>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/solvers/newton/newton_matrix.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "tests/support/random.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace {

/// Returns a crank on a moving axle, a rod on a spring and a redundant hinge loop. Lengths times L, masses times L^3
/// and times as they are: forces times L^4, moments times L^5.
std::string engine(double L, const std::string& drives) {
  return fmt::format(R"yaml(
parameters: {{L: {}}}
gravity: [0, "-9.81*L", 0]
nodes:
  crank: {{position: [0, "0.5*L", 0]}}
  coupler: {{position: ["0.5*L", "1.1*L", 0]}}
  rocker: {{position: ["L", "0.6*L", 0]}}
  tip: {{position: ["0.5*L", "1.5*L", 0]}}
elements:
  crank: {{type: rigid_body, node: crank, mass: "L^3", inertia: ["0.0833*L^5", "0.01*L^5", "0.0833*L^5"]}}
  coupler: {{type: rigid_body, node: coupler, mass: "L^3", inertia: ["0.01*L^5", "0.0833*L^5", "0.0833*L^5"],
            also: [tip]}}
  rocker: {{type: rigid_body, node: rocker, mass: "L^3", inertia: ["0.0833*L^5", "0.01*L^5", "0.0833*L^5"]}}
  spring: {{type: spring_damper, nodes: [ground, tip], stiffness: "30*L^3", damping: "0.2*L^3"}}
joints:
  a: {{type: hinge, nodes: [ground, crank], axis: [0, 0, 1], position: [0, 0, 0]}}
  b: {{type: hinge, nodes: [crank, coupler], axis: [0, 0, 1], position: [0, "L", 0]}}
  c: {{type: hinge, nodes: [coupler, rocker], axis: [0, 0, 1], position: ["L", "1.2*L", 0]}}
  d: {{type: hinge, nodes: [ground, rocker], axis: [0, 0, 1], position: ["L", 0, 0]}}
{})yaml",
                     L, drives);
}

}  // namespace

TEST_CASE("a mechanism moves alike in micrometres and in kilometres") {
  const std::string drives = GENERATE("", "drives: {motor: {joint: a, angle: \"0.3 + 2*t\"}}\n");
  const auto run = [&](double L) {
    const ReadyModel model(engine(L, drives));
    CHECK(model.system.set_aside().size() == 3);
    const State state = bielle::test::integrate(model, Scheme::generalized_alpha(0.8), 5e-3, 0.5);
    return std::pair(model.node(state, "tip").x, model.node(state, "rocker").Omega);
  };
  const auto [tip, spin] = run(1);
  for (const double L : {1e-6, 1e-3, 1e3}) {
    CAPTURE(L);
    const auto [tip_L, spin_L] = run(L);
    // Newton's tolerance is 1e-9 of the forces in each of 100 steps.
    CHECK((tip_L / L - tip).norm() < 1e-8);
    CHECK((spin_L - spin).norm() < 1e-7);
  }
}

TEST_CASE("a mechanism rests alike in micrometres and in kilometres") {
  const auto rest = [](double L) {
    const ReadyModel model(engine(L, ""));
    State state = model.system.start(0);
    solve_statics(model.system, model.environment(), 5, NewtonOptions{}, state);
    return model.node(state, "tip").x;
  };
  const Vector3 tip = rest(1);
  for (const double L : {1e-6, 1e-3, 1e3}) {
    CAPTURE(L);
    CHECK((rest(L) / L - tip).norm() < 1e-8);
  }
}

TEST_CASE("redundancy of a loop does not depend on where the mechanism stands") {
  // Two bodies a tenth of a millimetre long, at the distance of the Earth's centre from the origin.
  const ReadyModel model(R"yaml(
parameters: {X: 6.4e6, L: 1e-4}
nodes:
  a: {position: ["X", 0, 0]}
  b: {position: ["X + L", 0, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1e-8, 1e-8, 1e-8]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1e-8, 1e-8, 1e-8]}
joints:
  one: {type: spherical, nodes: [a, b], position: ["X", "L", 0]}
  two: {type: spherical, nodes: [a, b], position: ["X", 0, "L"]}
)yaml");
  // Two points of two bodies in common: their distance is held twice, all else is independent.
  CHECK(model.system.set_aside().size() == 1);
}

// The tangent of a time step is M/(beta h^2) next to B: as it stands, its condition grows with h^-4 and with any change
// of units. Forces come with a moment of the same size at the model's length, violations of constraints with those of a
// step: the solution is good to rounding at every step and in every unit.
TEST_CASE("a Newton step is as accurate with tiny steps and in tiny units") {
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  double least_condition = 1e300, largest_condition = 0;
  for (const double L : {1e-6, 1.0, 1e3})
    for (const double h : {1e-2, 1e-4, 1e-6, 1e-8}) {
      CAPTURE(L, h);
      std::string open = engine(L, "");  // no row is redundant without the last joint
      open.erase(open.find("  d: "));
      const ReadyModel model(open);
      const System& system = model.system;
      REQUIRE(system.set_aside().empty());
      const State state = system.start(0);
      NewtonMatrix linear(system);
      linear.factor(state, model.environment(), TangentWeights{1, 2 / h, 4 / (h * h), 0, 1}, nullptr);
      const int n = system.size();
      Wide A = Wide::Zero(n, n);
      for (int j = 0; j < n; ++j)
        for (int k = system.pattern().column_start()[static_cast<std::size_t>(j)];
             k < system.pattern().column_start()[static_cast<std::size_t>(j) + 1]; ++k)
          A(system.pattern().row()[static_cast<std::size_t>(k)], j) = linear.values()[static_cast<std::size_t>(k)];
      // Sizes of the unknowns and of their equations.
      Eigen::Matrix<long double, Eigen::Dynamic, 1> unknown(n);
      for (int i = 0; i < n; ++i)
        unknown[i] = i >= system.dofs() ? std::pow(L, 4) : system.kind(i) == Kind::rotation ? h * h : L * h * h;
      bielle::test::Random random(3);
      const VectorX x = random.vector(n).cwiseProduct(unknown.cast<double>());
      const VectorX r = -(A * x.cast<long double>()).cast<double>();
      // Rows and columns are scaled to order one, so that the reference is not affected by the tested problem.
      Wide even = A * unknown.asDiagonal();
      const Eigen::Matrix<long double, Eigen::Dynamic, 1> rows = even.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
      even = (rows.asDiagonal() * even).eval();
      const Eigen::Matrix<long double, Eigen::Dynamic, 1> exact =
          unknown.asDiagonal() * even.partialPivLu().solve(-(rows.asDiagonal() * r.cast<long double>())).eval();
      VectorX computed(n);
      linear.solve(r, computed);
      double wrong = 0;
      for (int i = 0; i < n; ++i)
        wrong = std::max(wrong, static_cast<double>(std::abs(computed[i] - exact[i]) / unknown[i]));
      CHECK(wrong < 1e-12);
      if (L != 1) continue;  // the 2-norm mixes lengths and angles
      Eigen::MatrixXd scaled = A.cast<double>();
      scaled.bottomRows(n - system.dofs()) *= linear.scale();
      scaled.rightCols(n - system.dofs()) *= linear.scale();
      const Eigen::VectorXd values = bielle::right_singular_vectors(scaled).values;
      const double condition = values[0] / values[n - 1];
      least_condition = std::min(least_condition, condition);
      largest_condition = std::max(largest_condition, condition);
    }
  CHECK(largest_condition < 1.1 * least_condition);
}
