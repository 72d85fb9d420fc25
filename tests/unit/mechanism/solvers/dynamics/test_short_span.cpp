// Short spans up to an event, where something is stiff.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/march_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_short_span {
namespace {

constexpr double h = 0.01, load = 100, stiffness = 1e9, omega = 1e6;

/// Returns a guide of 1e9 N/m under 1 g: 1e6 rad/s, in steps of 10 ms. A load of 100 N comes within 0.1 ms.
std::string guide(const std::string& event, const std::string& rise = "0.012, 0.0121") {
  return R"yaml(
nodes: {a: {position: [0, 0, 0]}}
elements: {m: {type: rigid_body, node: a, mass: 1e-3, inertia: [1, 1, 1]}}
joints: {s: {type: prismatic, nodes: [ground, a], position: [0, 0, 0], axis: [1, 0, 0], stiffness: 1e9}}
loads: {l: {node: a, force: ["-100*step(t, )yaml" +
         rise + R"yaml()", 0, 0]}}
measures: {clock: "t + 0*s.displacement"}
)yaml" + event;
}

struct Worst {
  double away = 0;      ///< distance of the guide from -F/k, once the load acts [m]
  double velocity = 0;  ///< [m/s]
};

std::string restart_at(double time) {
  return fmt::format("events: {{e: {{when: clock, crosses: {:.17g}, action: restart}}}}\n", time);
}

/// Calls act(time, node, step) after each step.
template <class Act>
void run(const std::string& text, double size, const Act& act) {
  const ReadyModel model(text);
  StepOptions options = fixed_steps(size);
  options.break_points = model.system.break_points();
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  March march(integration, 0, 0.2, options);
  while (!march.done()) {
    const MarchStep step = march.advance();
    act(integration.state().time, model.node(integration.state(), "a"), step);
  }
}

/// Returns the places of the guide at the times of the grid [m].
std::vector<double> places(const std::string& text, double size) {
  std::vector<double> places;
  run(text, size, [&](double /*time*/, const NodeState& node, const MarchStep& step) {
    if (step.on_grid) places.push_back(node.x.x());
  });
  return places;
}

Worst worst_of(const std::string& text) {
  Worst worst;
  run(text, h, [&](double time, const NodeState& node, const MarchStep& /*step*/) {
    if (time < 0.0121) return;
    worst.away = std::max(worst.away, std::abs(node.x.x() + load / stiffness));
    worst.velocity = std::max(worst.velocity, std::abs(node.v.x()));
  });
  return worst;
}

}  // namespace

TEST_CASE("a stiff guide stays where its load holds it, wherever an event cuts a step") {
  const Worst without = worst_of(guide(""));
  // The step s = 0.1 ms in which the load comes leaves (1 - alpha_m)/((1 - alpha_f) beta (omega s)^2) of F/k = 4e-4.
  CHECK(without.away < 1e-3 * load / stiffness);
  for (const double away : {1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 9e-3})
    for (const double side : {-1.0, 1.0}) {
      const Worst with = worst_of(guide(restart_at(0.05 + side * away * h)));
      INFO(side * away << " h: " << with.away << ", without the event " << without.away);
      // Steps that do not resolve the guide leave a velocity in it, which it swings by once a step resolves it. Neither
      // amplitude grows, except by the scheme's change of step.
      CHECK(with.away < 3 * (without.away + without.velocity / omega));
    }
}

TEST_CASE("an event changes a stiff guide whose load grows over many steps by less than the second order of steps") {
  const char* rise = "0.01, 0.11";
  for (const double phase : {1e-8, 1e-7, 1e-6, 1e-5, -1e-5}) {
    double before = 0;
    for (const double size : {h, h / 2, h / 4}) {
      const std::vector<double> without = places(guide("", rise), size),
                                with = places(guide(restart_at(0.05 + phase), rise), size);
      REQUIRE(with.size() == without.size());
      double worst = 0;
      for (std::size_t k = 0; k < with.size(); ++k)
        worst = std::max(worst, std::abs(with[k] - without[k]) / (load / stiffness));
      INFO("h = " << size << ", " << phase << " s behind 0.05 s: " << worst << " of F/k");
      // Velocities of the scheme are wrong by up to F/(k T) (h/T)^2, T = 0.1 s: 1e-8 m/s, by which the guide swings.
      CHECK(worst < 1e-5);
      if (before > 0) CHECK(worst < before / 4);
      before = worst;
    }
  }
}

}  // namespace test_short_span
