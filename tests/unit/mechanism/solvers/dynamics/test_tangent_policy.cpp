// The lifetime of the tangent's factors: decisions from given costs, and what whole motions cost with each policy.
#include <algorithm>

#include <catch2/catch.hpp>

#include "mechanism/solvers/dynamics/tangent_policy.hpp"
#include "tests/support/chain.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::chain;
using bielle::test::ReadyModel;

namespace test_tangent_policy {
namespace {

constexpr double iteration = 1, factorisation = 3;

TangentPolicy policy_of(Tangent wanted) {
  TangentPolicy policy(wanted);
  policy.set_costs({0.75 * iteration, factorisation, 0.25 * iteration});
  return policy;
}

/// Makes steps of a motion in which old factors take `old` iterations and new ones take one.
/// @returns which of the steps began with new factors
std::vector<bool> steps(TangentPolicy& policy, int count, int old) {
  std::vector<bool> renewed;
  bool usable = false;
  for (int k = 0; k < count; ++k) {
    renewed.push_back(!usable || policy.renews_at_start());
    usable = renewed.back() ? policy.judge(0, iteration + factorisation, 1) : policy.judge(0, old * iteration, 0);
  }
  return renewed;
}

long count(const std::vector<bool>& steps) { return std::count(steps.begin(), steps.end(), true); }

struct Course {
  State end;
  long iterations = 0, factorisations = 0, evaluations = 0, solutions = 0;
};

Course run(const ReadyModel& model, Tangent tangent, double h, int steps,
           ConstraintForm form = ConstraintForm::corrected) {
  NewtonOptions options;
  options.tangent = tangent;
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0),
                              form, options);
  integration.start(h);
  Course course;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = integration.step(h);
    course.iterations += report.iterations;
    course.factorisations += report.factorisations;
    course.evaluations += report.evaluations;
    course.solutions += report.solutions;
  }
  course.end = integration.state();
  return course;
}

StepCosts costs_of(const ReadyModel& model, double h) {
  NewtonMatrix linear(model.system);
  linear.factor(model.system.start(0), model.environment(), TangentWeights{1, 2 / h, 4 / (h * h), 2 / h, 1}, nullptr);
  return count_costs(model.system, model.system.size(), 1, linear.factor_cost());
}

/// An arm of beams that is spun up: factors of one step do not serve the next one while it turns fast.
const char* const spun_arm = R"yaml(
nodes: {hub: {}, tip: {position: [10, 0, 0]}}
elements:
  arm: {type: beam, nodes: [hub, tip], elements: 10,
        section: {EA: 2.8e7, GAy: 1e7, GAz: 1e7, GJ: 1.4e4, EIy: 1.4e4, EIz: 1.4e4, mass_per_length: 1.2, Jx: 1.2e-3, Jy: 6e-4, Jz: 6e-4}}
joints: {pivot: {type: hinge, nodes: [ground, hub], axis: [0, 0, 1]}}
drives: {motor: {joint: pivot, angle: "if(t < 15, 0.4*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1)), 6*t - 45)"}}
)yaml";

}  // namespace

TEST_CASE("factors are renewed when reusing them costs more, and reused again when it costs less") {
  TangentPolicy policy = policy_of(Tangent::automatic);
  // Two iterations cost less than one with a factorisation.
  CHECK(count(steps(policy, 100, 2)) == 1);
  // Five cost more: after each attempt twice as many steps are made without another one, up to sixteen.
  const std::vector<bool> dear = steps(policy, 400, 5);
  CHECK(count(dear) >= 370);
  CHECK(std::find(dear.end() - 18, dear.end(), false) != dear.end());
  // The next attempt notices that it has become cheap.
  CHECK(count(steps(policy, 100, 2)) <= 17);
  CHECK(count(steps(policy, 100, 2)) == 1);
}

TEST_CASE("factors that fail within each step are renewed at its beginning") {
  TangentPolicy policy = policy_of(Tangent::automatic);
  double spent = 0;
  constexpr int count = 300;
  policy.judge(0, iteration + factorisation, 1);
  for (int k = 0; k < count; ++k) {
    const double wasted = policy.renews_at_start() ? 0 : iteration, cost = wasted + iteration + factorisation;
    policy.judge(wasted, cost, 1);
    spent += cost;
  }
  CHECK(spent < 1.02 * count * (iteration + factorisation));
}

TEST_CASE("a policy that the user chooses is kept") {
  TangentPolicy reused = policy_of(Tangent::reused), renewed = policy_of(Tangent::renewed);
  for (int k = 0; k < 100; ++k) {
    CHECK(renewed.renews_at_start());
    reused.judge(k > 0 ? iteration : 0, 2 * iteration + factorisation, 1);
    CHECK_FALSE(reused.renews_at_start());
  }
  CHECK(reused.ever_reuses());
  CHECK_FALSE(renewed.ever_reuses());
}

TEST_CASE("old factors are used in a step while what is left costs no more than new ones") {
  const TangentPolicy policy = policy_of(Tangent::automatic);
  CHECK(policy.worthwhile(1e4, 1e3));        // three iterations are left: two more than with new factors
  CHECK(policy.worthwhile(1e5, 1e4));        // four: three more, which cost as much as a factorisation
  CHECK_FALSE(policy.worthwhile(1e6, 1e5));  // five
  CHECK_FALSE(policy.worthwhile(1.5, 1));    // hardly any progress
  CHECK(policy.worthwhile(1e3, 0));          // nothing is left
  CHECK_FALSE(policy.worthwhile(1, 1e300 * 1e10));
}

TEST_CASE("motions with any policy agree, and the automatic one costs no more than the better of the others") {
  struct Case {
    const char* name;
    std::string text;
    double h;
    int steps;
    double position;  ///< largest difference of positions [m]
  };
  // Residuals are within 1e-9 of the forces in each policy; the steps add up.
  const Case cases[] = {{"three links", chain(3, "spherical"), 1e-3, 1000, 1e-7},
                        {"twelve links", chain(12, "hinge, axis: [0, 1, 0]"), 1e-3, 300, 1e-7},
                        {"spun arm", spun_arm, 5e-3, 2000, 1e-6}};
  for (const Case& each : cases) {
    CAPTURE(each.name);
    const ReadyModel model(each.text);
    const StepCosts costs = costs_of(model, each.h);
    const auto cost = [&](const Course& course) {
      return course.evaluations * costs.evaluation + course.solutions * costs.solution +
             course.factorisations * costs.factorisation;
    };
    const Course renewed = run(model, Tangent::renewed, each.h, each.steps),
                 reused = run(model, Tangent::reused, each.h, each.steps),
                 automatic = run(model, Tangent::automatic, each.h, each.steps);
    CHECK(renewed.factorisations == renewed.iterations);
    CHECK(cost(automatic) < 1.05 * std::min(cost(renewed), cost(reused)));
    for (const Course* other : {&renewed, &reused})
      for (std::size_t k = 0; k < automatic.end.nodes.size(); ++k)
        CHECK((automatic.end.nodes[k].x - other->end.nodes[k].x).norm() < each.position);
    // A second run makes the same decisions, to the bit.
    const Course again = run(model, Tangent::automatic, each.h, each.steps);
    CHECK(again.factorisations == automatic.factorisations);
    CHECK(again.end.multiplier == automatic.end.multiplier);
  }
}

TEST_CASE("an arm that is spun up takes one iteration in most steps") {
  const ReadyModel model(spun_arm);
  const Course automatic = run(model, Tangent::automatic, 5e-3, 4000), reused = run(model, Tangent::reused, 5e-3, 4000);
  CHECK(automatic.iterations < 1.5 * 4000);
  CHECK(reused.iterations > 2 * 4000);
}

TEST_CASE("costs are in proportion to the model") {
  for (const std::string joint : {"spherical", "hinge, axis: [0, 1, 0]"}) {
    const ReadyModel small(chain(20, joint)), large(chain(200, joint));
    const StepCosts one = costs_of(small, 1e-3), ten = costs_of(large, 1e-3);
    CHECK(ten.evaluation == Approx(10 * one.evaluation).epsilon(0.05));
    CHECK(ten.factorisation == Approx(10 * one.factorisation).epsilon(0.2));
    CHECK(ten.solution == Approx(10 * one.solution).epsilon(0.2));
  }
}

}  // namespace test_tangent_policy
