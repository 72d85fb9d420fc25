// The start of Newton's method in a step: exact for polynomials, of an order that does not amplify noise, reset after
// discontinuities, and without influence on the end of the step.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_extrapolation {
namespace {

const char* const double_pendulum = R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [0.5, 0, 0]}, b: {position: [1.5, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1e-3, 1/12, 1/12]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1e-3, 1/12, 1/12]}
joints:
  a: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}
  b: {type: hinge, nodes: [a, b], position: [1, 0, 0], axis: [0, 1, 0]}
)yaml";

/// A pendulum whose rod is a spring that rings with 2000 rad/s, drawn 1 % too long.
const char* const stiff_pendulum = R"yaml(
gravity: [0, 0, -9.81]
nodes: {m: {position: [1, 0, 0], fixed: [rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], stiffness: 4e6, length: 0.99}
)yaml";

struct Count {
  State end;
  long iterations = 0, orders = 0, steps = 0;
};

Count run(const ReadyModel& model, int order, double h, double end, ConstraintForm form = ConstraintForm::corrected,
          bool reuse = true, const Scheme& scheme = Scheme::generalized_alpha(0.8)) {
  NewtonOptions options;
  options.extrapolation = order;
  options.tangent = reuse ? Tangent::reused : Tangent::renewed;
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0), form, options);
  integration.start(h);
  Count count;
  for (count.steps = 0; count.steps < std::lround(end / h); ++count.steps) {
    const StepReport report = integration.step(h);
    count.iterations += report.iterations;
    count.orders += report.order;
    CHECK(report.order <= order);
  }
  count.end = integration.state();
  return count;
}

VectorX values_at(double t) {
  VectorX values(3);
  values << 1 + t, 2 - t * t * t, 3 + 5 * t - 2 * std::pow(t, 4);
  return values;
}

}  // namespace

TEST_CASE("an extrapolation of order p is exact for polynomials of degree p, whatever the sizes of the steps") {
  Extrapolation extrapolation(3, Extrapolation::most_order);
  CHECK(extrapolation.highest_order() == -1);
  for (const double t : {-3.0, -1.0, 0.0, 0.3, 1.5, 1.6}) extrapolation.add(t, values_at(t));
  REQUIRE(extrapolation.highest_order() == 4);
  const VectorX expected = values_at(2.5);
  VectorX values;
  for (int order = 0; order <= 4; ++order) {
    CAPTURE(order);
    extrapolation.calc(order, 2.5, values);
    const auto is_exact = [&](int k) { return std::abs(values[k] - expected[k]) < 1e-11 * std::abs(expected[k]); };
    CHECK(is_exact(0) == (order >= 1));
    CHECK(is_exact(1) == (order >= 3));
    CHECK(is_exact(2) == (order >= 4));
  }
  extrapolation.forget();
  extrapolation.add(2, values_at(2));
  CHECK(extrapolation.highest_order() == 0);
  extrapolation.calc(0, 3, values);
  CHECK(values == values_at(2));
}

TEST_CASE("no order above the allowed one is offered, and a choice lasts until there is reason to choose anew") {
  Extrapolation extrapolation(3, 2);
  for (int k = 0; k < 5; ++k) extrapolation.add(k, values_at(k));
  CHECK(extrapolation.highest_order() == 2);
  CHECK(extrapolation.wants_choice(1));
  extrapolation.choose(2, 1);
  CHECK(extrapolation.order(5) == 2);
  CHECK_FALSE(extrapolation.wants_choice(1));
  CHECK(extrapolation.wants_choice(10));  // the start of the iteration is worse
  for (int k = 0; k < 16; ++k) extrapolation.note(1);
  CHECK(extrapolation.wants_choice(1));
  Extrapolation none(3, -1);
  for (int k = 0; k < 3; ++k) none.add(k, values_at(k));
  CHECK(none.highest_order() == 0);
}

TEST_CASE("steps of very different sizes are not extrapolated over in a high order") {
  Extrapolation extrapolation(3, 4);
  for (int k = 0; k < 5; ++k) extrapolation.add(k, values_at(k));
  CHECK(extrapolation.highest_order(5) == 4);
  CHECK(extrapolation.highest_order(6) == 2);  // twice as far: weights 15 -40 45 -24 5, then 10 -20 15 -4
  CHECK(extrapolation.highest_order(40) == 0);
  // An event has shortened a step to nearly zero: its end replaces its beginning.
  extrapolation.add(4 + 1e-10, values_at(4 + 1e-10));
  VectorX values;
  extrapolation.calc(extrapolation.highest_order(5), 5, values);
  CHECK((values - values_at(5)).norm() < 1e-6 * values.norm());
}

TEST_CASE("an event on a time of the grid does not spoil the start of the next step") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [0.5, 0, 0]}}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1e-3, 1/12, 1/12]}}
joints: {a: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  constexpr double h = 5e-3;
  integration.start(h);
  for (int k = 0; k < 20; ++k) integration.step(h);
  const long before = integration.step(h).iterations;
  // In steps that are much shorter, accelerations are rounding: the program makes none by the scheme (short_span.hpp).
  constexpr double left = 1e-4 * h;
  integration.change_step(left);
  integration.step(left);
  integration.change_step(h);
  CHECK(integration.step(h).iterations <= before + 2);
}

TEST_CASE("what an extrapolation knows is restored with its choice") {
  Extrapolation one(3, 4), other(3, 4);
  for (int k = 0; k < 7; ++k) one.add(0.1 * k * k, values_at(k));
  one.choose(3, 2.5);
  one.note(1.5);
  Archive written;
  one.exchange(written);
  Archive read(written.values());
  other.exchange(read);
  CHECK(read.exhausted());
  CHECK(other.order(4) == 3);
  VectorX expected, found;
  for (int order = 0; order <= 4; ++order) {
    one.calc(order, 4.2, expected);
    other.calc(order, 4.2, found);
    CHECK(found == expected);
  }
}

TEST_CASE("a smooth motion takes one iteration per step with new tangents, and is the same") {
  const ReadyModel model(double_pendulum);
  const auto compare = [&](ConstraintForm form) {
    const Count without = run(model, 0, 5e-3, 1, form, false), with = run(model, 4, 5e-3, 1, form, false);
    // Newton's tolerance, 1e-9 of the forces, adds up over the steps.
    CHECK((model.node(with.end, "b").x - model.node(without.end, "b").x).norm() < 1e-9);
    CHECK((with.end.multiplier - without.end.multiplier).norm() < 1e-7 * with.end.multiplier.norm());
    return std::pair(without, with);
  };
  const auto [without, with] = compare(ConstraintForm::position);
  CHECK(static_cast<double>(without.iterations) > 1.8 * static_cast<double>(without.steps));
  CHECK(static_cast<double>(with.iterations) < 1.1 * static_cast<double>(with.steps));
  CHECK(static_cast<double>(with.orders) > 2 * static_cast<double>(with.steps));
  const auto [plain, extrapolated] = compare(ConstraintForm::stabilised);
  CHECK(extrapolated.iterations <= plain.iterations);
}

TEST_CASE("where accelerations ring from step to step, extrapolation steps back") {
  const ReadyModel model(stiff_pendulum);
  // 20 rad of the ringing per step: the scheme alternates.
  const Count without = run(model, 0, 1e-2, 2), with = run(model, 4, 1e-2, 2);
  CHECK(static_cast<double>(with.iterations) < 1.1 * static_cast<double>(without.iterations));
  CHECK((model.node(with.end, "m").x - model.node(without.end, "m").x).norm() < 1e-8);
}

TEST_CASE("multipliers that alternate are not amplified by extrapolation") {
  // Newmark's rule keeps an alternating error of multipliers forever.
  const ReadyModel model(double_pendulum);
  const Count without = run(model, 0, 5e-3, 1, ConstraintForm::position, false, Scheme::newmark()),
              with = run(model, 4, 5e-3, 1, ConstraintForm::position, false, Scheme::newmark());
  CHECK(with.iterations <= without.iterations);
  CHECK((with.end.multiplier - without.end.multiplier).norm() < 1e-6 * with.end.multiplier.norm());
}

TEST_CASE("steps that change in size are extrapolated over; after a discontinuity nothing is") {
  const ReadyModel model(double_pendulum);
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  integration.start(1e-3);
  CHECK(integration.step(1e-3).order == 0);
  for (int k = 0; k < 20; ++k) integration.step(1e-3);
  integration.change_step(1.5e-3);
  const StepReport changed = integration.step(1.5e-3);
  CHECK(changed.order > 0);
  const Jump jump = integration.begin_branch(1.5e-3, {});
  integration.start_branch(1.5e-3, jump.time);
  CHECK(integration.step(1.5e-3).order == 0);
  for (int k = 0; k < 5; ++k) integration.step(1.5e-3);
  integration.restart(1e-3);
  CHECK(integration.step(1e-3).order == 0);
}

TEST_CASE("a start that a component refuses is replaced by unchanged accelerations") {
  // The push rises until it stays. An extrapolation of its rise would give 1.6538 m/s at t = 0.0105, beyond the 1.652
  // m/s at which the damper's force ends; unchanged accelerations give the correct 1.65 m/s.
  const ReadyModel model(R"yaml(
nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], force: "1e-6*sqrt(1.652 + 1000*abs(t - 0.0105) - v)", length: 1}
loads: {push: {node: m, force: ["if(t < 0.01, 30000*t, 300)", 0, 0]}}
)yaml");
  constexpr double h = 5e-4;
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  integration.start(h);
  int order = 0, replaced = 0;
  for (int k = 0; k < 40; ++k) {
    const StepReport report = integration.step(h);
    if (order > 0 && report.order == 0) ++replaced;
    order = report.order;
  }
  CHECK(replaced == 1);
  CHECK(model.node(integration.state(), "m").v.x() == Approx(1.5 + 300 * 0.01).epsilon(1e-3));
}

}  // namespace test_extrapolation
