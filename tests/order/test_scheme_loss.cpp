// The scheme's own dissipation in a motion: exact for linear oscillations however long the steps are, of the
// theoretical order in motions that turn.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace {

const Scheme schemes[] = {Scheme::generalized_alpha(0),
                          Scheme::generalized_alpha(0.5),
                          Scheme::generalized_alpha(0.8),
                          Scheme::generalized_alpha(0.95),
                          Scheme::generalized_alpha(1),
                          Scheme::hht(0.1),
                          Scheme::hht(0.3),
                          Scheme::newmark()};

/// Returns masses of 1 and 2 kg in a row on springs of 1 N/m: natural frequencies 0.54 and 1.31 rad/s.
/// @param nodes,elements  more of them
ReadyModel oscillators(const std::string& nodes = "", const std::string& elements = "") {
  return ReadyModel(fmt::format(R"yaml(
nodes:
  p: {{position: [100.2, 0, 0], velocity: [0.1, 0, 0], fixed: [y, z, rx, ry, rz]}}
  q: {{position: [200.1, 0, 0], velocity: [-0.2, 0, 0], fixed: [y, z, rx, ry, rz]}}
{}elements:
  p: {{type: point_mass, node: p, mass: 1}}
  q: {{type: point_mass, node: q, mass: 2}}
  first: {{type: spring_damper, nodes: [ground, p], stiffness: 1, length: 100}}
  second: {{type: spring_damper, nodes: [p, q], stiffness: 1, length: 100}}
{})yaml",
                                nodes, elements));
}

double stored(const ReadyModel& model, const State& state) {
  const Energy energy = model.system.energy(state, model.environment());
  return energy.kinetic + energy.elastic + energy.gravity;
}

struct Books {
  double lost = 0, loss = 0, lent = 0;  ///< stored energy; loss to the scheme; term L, which is returned
};

/// Without start correction: A = a at the start. The returned term is computed directly from the states.
Books run(const ReadyModel& model, const Scheme& scheme, double h, int steps) {
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0));
  const double alpha_m = scheme.alpha_m, alpha_f = scheme.alpha_f, g = alpha_f - alpha_m, p = 0.5 - alpha_m,
               r = 0.5 - alpha_f, b = scheme.beta - scheme.gamma / 2,
               l = g > 0 ? (2 * p * (r * p + b) - r * (p * p - g * p + g * g + b) - 2 * b * g) / g : 0;
  const auto rates = [&](Vector3 NodeState::*rate) {
    return Vector3((model.node(integration.state(), "p").*rate).x(), (model.node(integration.state(), "q").*rate).x(),
                   0);
  };
  const auto product = [](const Vector3& x, const Vector3& y) { return x.x() * y.x() + 2 * x.y() * y.y(); };  // by mass
  Vector3 a = rates(&NodeState::a), A = a;
  const auto lent = [&] {
    const Vector3 v = rates(&NodeState::v), e = A - a;
    return r * h * (product(v, e) + h * g * product(a, a) / 2 + h * p * product(a, e)) +
           h * h * (b * product(A, A) + l * product(e, e)) / 2;
  };
  const double before = stored(model, integration.state());
  Books energy_balance;
  energy_balance.lent = -lent();
  for (int k = 0; k < steps; ++k) {
    integration.step(h);
    const Vector3 now = rates(&NodeState::a);
    A = ((1 - alpha_f) * now + alpha_f * a - alpha_m * A) / (1 - alpha_m);
    a = now;
  }
  energy_balance.lent += lent();
  energy_balance.lost = before - stored(model, integration.state());
  energy_balance.loss = integration.scheme_loss();
  return energy_balance;
}

}  // namespace

TEST_CASE("in linear oscillations all that is lost is the scheme's dissipation, whatever the step") {
  const ReadyModel model = oscillators();
  const double energy = stored(model, model.system.start(0));
  for (const Scheme& scheme : schemes)
    for (const double h : {0.05, 0.3, 1.0, 3.0, 10.0}) {
      const Books energy_balance = run(model, scheme, h, 90);
      CAPTURE(scheme.alpha_m, scheme.alpha_f, h, energy_balance.lost, energy_balance.loss, energy_balance.lent);
      CHECK(energy_balance.loss + energy_balance.lent == Approx(energy_balance.lost).margin(1e-10 * energy));
      if (!SchemeLoss::is_of(scheme)) CHECK(energy_balance.loss == 0);
      if (SchemeLoss::is_of(scheme) && h == 1.0) CHECK(energy_balance.loss > 1e-3 * energy);
    }
}

TEST_CASE("nodes whose motion is prescribed add nothing to the scheme's dissipation") {
  const ReadyModel alone = oscillators(),
                   with =
                       oscillators("  far: {position: [0, 9, 0], fixed: [y, z, rx, ry, rz], motion: {x: \"100*t\"}}\n",
                                   "  far: {type: point_mass, node: far, mass: 1000}\n");
  const Scheme scheme = Scheme::generalized_alpha(0.8);
  const double expected = run(alone, scheme, 1, 50).loss;
  CHECK(run(with, scheme, 1, 50).loss == Approx(expected).epsilon(1e-7));
}

TEST_CASE("a long motion is judged by some of its steps, also where they keep time with it") {
  const ReadyModel model = oscillators();
  for (const double h :
       {0.3, 2 * M_PI / (10 * 0.5411961), 2 * M_PI / (8 * 1.3065630)}) {  // ten and eight steps per period
    const Books energy_balance = run(model, Scheme::generalized_alpha(0.98), h, 4000);
    CAPTURE(h, energy_balance.lost, energy_balance.loss);
    CHECK(energy_balance.loss == Approx(energy_balance.lost).epsilon(0.05));
  }
}

TEST_CASE(
    "of what a pendulum loses the scheme's part falls with the third power of the step, the errors with the second") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [1, 0, 0]}}
elements: {m: {type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints: {g: {type: hinge, nodes: [ground, a], axis: [0, 1, 0], position: [0, 0, 0]}}
)yaml");
  const auto parts = [&](double h) {
    TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                model.system.start(0));
    integration.start(h);
    const double before = stored(model, integration.state());
    for (long k = std::lround(0.6 / h); k > 0; --k) integration.step(h);
    const double loss = integration.scheme_loss();
    return std::pair{loss, before - stored(model, integration.state()) - loss};
  };
  auto coarse = parts(0.02);
  for (const double h : {0.01, 0.0075}) {
    const auto fine = parts(h);
    CAPTURE(h, coarse, fine);
    const double ratio = 0.02 / h;
    CHECK(std::log(coarse.first / fine.first) / std::log(ratio) == Approx(3).margin(0.15));
    CHECK(std::log(coarse.second / fine.second) / std::log(ratio) == Approx(2).margin(0.15));
    CHECK(fine.first > 0);
  }
}
