// Unknowns with their own scale are judged by it: a bristle of a micrometre in one model with a pressure of a hundred
// bar.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/dynamics/march.hpp"
#include "tests/support/scalar_amplitude.hpp"
#include "tests/support/scalar_equation.hpp"

using namespace bielle::mechanism;
using bielle::test::ScalarAmplitude;
using bielle::test::ScalarEquation;
using Catch::Contains;

namespace test_own_scales {
namespace {

constexpr double bristle_size = 1e-6, pressure_size = 1e7;

/// du/dt = (U - u |u|/U)/tau: from zero, u = U tanh(t/tau).
std::unique_ptr<Component> growing(const char* name, const char* units, double U, double tau, double start,
                                   double scale) {
  const Declaration::Scalar unknown{"value", units, start, ConstraintKind::holonomic, scale};
  return std::make_unique<ScalarEquation>(name, unknown, [=](double u, double rate) -> ScalarEquation::Law {
    return {rate - (U - u * std::abs(u) / U) / tau, 2 * std::abs(u) / (U * tau), 1};
  });
}

std::unique_ptr<Component> bristle() { return growing("bristle", "m", bristle_size, 0.01, 0, bristle_size); }
std::unique_ptr<Component> pressure() { return growing("pressure", "Pa", pressure_size, 10, 0, pressure_size); }

struct Ready {
  MechanismFile file = read_mechanism_text(R"yaml(
nodes: {mass: {position: [1, 0, 0], velocity: [1, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 1, inertia: [1, 1, 1]}}
)yaml",
                                           "model.yaml");
  std::unique_ptr<System> system;
  template <class... Components>
  explicit Ready(Components... components) {
    const auto add = [&](std::unique_ptr<Component> component) {
      const Entry entry{Section::elements, component->name()};
      file.model.add(std::move(component), entry);
    };
    (add(std::move(components)), ...);
    system = std::make_unique<System>(file.model);
  }
  TimeIntegration integration(const NewtonOptions& options = {}) const {
    return TimeIntegration(*system, file.model.environment, Scheme::generalized_alpha(0.8), system->start(0),
                           ConstraintForm::corrected, options);
  }
};

/// Returns the first first-order unknown at the end of each of 100 steps.
std::vector<double> values(const Ready& model, const NewtonOptions& options) {
  TimeIntegration integration = model.integration(options);
  integration.start(1e-3);
  std::vector<double> result;
  for (int k = 0; k < 100; ++k) {
    const StepReport report = integration.step(1e-3);
    CHECK(report.worst_ratio <= 1);
    result.push_back(integration.state().first_order[0]);
  }
  return result;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

/// Adaptive steps through 0.1 s.
struct March01 {
  TimeIntegration integration;
  March march;
  double worst = 0;  ///< error of the first unknown by the closed form, in its scale
  explicit March01(const Ready& model, double tolerance, double h = 1e-4)
      : integration(model.integration()), march(integration, 0, 0.1, {h, tolerance, 0.01, {}}) {
    while (!march.done()) {
      march.advance();
      const State& state = integration.state();
      worst = std::max(worst, std::abs(state.first_order[0] / bristle_size - std::tanh(state.time / 0.01)));
    }
  }
};

}  // namespace

TEST_CASE("Newton's method solves for a bristle as well next to a pressure as alone") {
  for (const bool reuse : {false, true}) {
    NewtonOptions options, strict;
    options.tangent = strict.tangent = reuse ? Tangent::reused : Tangent::renewed;
    strict.tolerance = 1e-13;
    const Ready alone(bristle()), together(bristle(), pressure()), other(pressure()), both(pressure(), bristle());
    const std::vector<double> exact = values(alone, strict), exact_pressure = values(other, strict);
    // 1e-9 of the terms of its equation, in each of 100 steps. Relative to 1/h, 1/tau is 0.1 and 1e-4.
    const double allowed = 100 * 0.1 * options.tolerance, allowed_pressure = 100 * 1e-4 * options.tolerance;
    CHECK(largest_difference(values(alone, options), exact) / bristle_size < allowed);
    CHECK(largest_difference(values(together, options), exact) / bristle_size < allowed);
    CHECK(largest_difference(values(both, options), exact_pressure) / pressure_size < allowed_pressure);
  }
}

TEST_CASE("Newton's method solves for small amplitudes as well next to large ones as alone, with mass and without") {
  const auto amplitude = [](double size, double mass) {
    const Declaration::Scalar unknown{"value", "m", 0, ConstraintKind::holonomic, size};
    return std::make_unique<ScalarAmplitude>("amplitude", unknown, ScalarAmplitude::Law{mass, 1, 1e3, size, 30});
  };
  const auto run = [](const Ready& model, const NewtonOptions& options) {
    TimeIntegration integration = model.integration(options);
    integration.start(1e-3);
    std::vector<double> result;
    for (int k = 0; k < 100; ++k) {
      integration.step(1e-3);
      result.push_back(integration.state().amplitude[0]);
    }
    return result;
  };
  constexpr double small = 1e-6, large = 1e3;
  for (const double mass : {0.0, 1e-2})
    for (const bool reuse : {false, true}) {
      CAPTURE(mass, reuse);
      NewtonOptions options, strict;
      options.tangent = strict.tangent = reuse ? Tangent::reused : Tangent::renewed;
      strict.tolerance = 1e-13;
      const Ready alone(amplitude(small, mass)), together(amplitude(small, mass), amplitude(large, 10));
      const std::vector<double> exact = run(alone, strict);
      // 1e-9 of its forces in each of 100 steps.
      CHECK(largest_difference(run(alone, options), exact) / small < 1e-7);
      CHECK(largest_difference(run(together, options), exact) / small < 1e-7);
    }
}

TEST_CASE("adaptive steps keep the error of a bristle to its tolerance next to a pressure") {
  const Ready alone(bristle()), together(bristle(), pressure());
  for (const double tolerance : {1e-4, 1e-5}) {
    CAPTURE(tolerance);
    const March01 one(alone, tolerance), both(together, tolerance);
    CHECK(one.march.log().steps == both.march.log().steps);
    CHECK(both.worst == Approx(one.worst).epsilon(1e-6));
    // The bound allows for the local errors of some fifty steps, which have one sign while the bristle bends.
    CHECK(both.worst < 20 * tolerance);
  }
}

TEST_CASE("what is much smaller than its scale does not make steps small") {
  // A bristle starts at 1e-9 of its scale and decays within a thousandth of the time.
  const auto fading = [](double scale) {
    const Declaration::Scalar unknown{"value", "m", 1e-9 * bristle_size, ConstraintKind::holonomic, scale};
    return std::make_unique<ScalarEquation>("fading", unknown, [](double u, double rate) -> ScalarEquation::Law {
      return {rate + u / 1e-4, 1e4, 1};
    });
  };
  const Ready without(pressure()), with(pressure(), fading(bristle_size)), no_scale(pressure(), fading(0));
  const long steps = March01(without, 1e-5).march.log().steps;
  CHECK(March01(with, 1e-5).march.log().steps == steps);
  CHECK(March01(no_scale, 1e-5).march.log().steps > 2 * steps);
}

TEST_CASE("an unknown that brings its scale starts from zero without small steps") {
  // Relative to the largest value so far, which is as small as the step, any error would be large.
  const auto log = [](double scale) {
    const Ready model(growing("bristle", "m", bristle_size, 0.01, 0, scale));
    return March01(model, 1e-4, 1e-3).march.log();
  };
  const MarchLog with = log(bristle_size), without = log(0);
  CHECK(with.smallest > 5e-4);
  CHECK(with.smallest > 2 * without.smallest);
  // The first step's error is unknown: it must not enlarge the next step, which would then be refused.
  CHECK(with.refused_by_error < with.steps / 5);
}

TEST_CASE("equations are reported with names and units of their own") {
  const auto scalar = [](Declaration::Scalar unknown) {
    return std::make_unique<ScalarEquation>("ram", unknown, [](double u, double rate) -> ScalarEquation::Law {
      return {rate + u * u + 3, 2 * u, 1};
    });
  };
  Ready model(scalar({"pressure 1", "Pa", 0}));
  CHECK(model.system->equation_name(model.system->dofs()) == "equation of pressure 1 of element 'ram'");
  CHECK(model.system->equation_units(model.system->dofs()) == "Pa/s");
  CHECK(model.system->scale(model.system->dofs()) == 0);
  CHECK(model.system->scale(0) == 0);

  const Ready declared(scalar({"pressure 1", "Pa", 0, ConstraintKind::holonomic, 1e7, "m^3/s"}));
  CHECK(declared.system->equation_units(declared.system->dofs()) == "m^3/s");
  CHECK(declared.system->scale(declared.system->dofs()) == 1e7);

  // Without iterations the first residual is kept.
  NewtonOptions none;
  none.iterations = 0;
  TimeIntegration integration = model.integration(none);
  integration.start(1e-3);
  CHECK_THAT(integration.attempt(1e-3).refusal,
             Contains("equation of pressure 1 of element 'ram' (") && Contains(" Pa/s)"));
}

TEST_CASE("units of equations follow from those of unknowns where a component says none") {
  MechanismFile file = read_mechanism_text(R"yaml(
nodes:
  a: {position: [0, 0, 0]}
  b: {position: [0, 0, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}
joints:
  h: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], position: [0, 0, 0]}
  s: {type: prismatic, nodes: [ground, b], axis: [1, 0, 0], position: [0, 0, 0]}
drives:
  turn: {joint: h, rate: 1}
  push: {joint: s, speed: 1}
)yaml",
                                           "model.yaml");
  /// Amplitudes alone.
  class Modes : public Component {
   public:
    Modes() : Component("modes", "modes") {}
    void declare(Declaration& declaration) const override {
      declaration.amplitudes = {{"modal", "m kg^0.5"}, {"massless", "m"}, {"turning", "rad"}};
    }
    void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
    void add_tangent(const LocalState&, LocalTangent&) const override {}
  };
  file.model.add(std::make_unique<Modes>(), Entry{Section::elements, "modes"});
  const System system(file.model);
  const auto units_of = [&](const std::string& name) {
    for (int i = 0; i < system.size(); ++i)
      if (system.equation_name(i).find(name) != std::string::npos) return system.equation_units(i);
    return std::string("(no such equation)");
  };
  CHECK(units_of("constraint z of joint 'h'") == "m");
  CHECK(units_of("constraint rx of joint 'h'") == "rad");
  CHECK(units_of("drive 'turn'") == "rad/s");
  CHECK(units_of("drive 'push'") == "m/s");
  CHECK(units_of("modal of element") == "N/sqrt(kg)");
  CHECK(units_of("massless of element") == "N");
  CHECK(units_of("turning of element") == "N m");
}

}  // namespace test_own_scales
