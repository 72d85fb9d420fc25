// Forces that depend on reactions: the start of a motion, the convergence of Newton's method, and cases with no
// solution, or more than one.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/reaction_friction.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::message_of;
using bielle::test::ReactionFriction;
using bielle::test::ReadyModel;

namespace {

const Joint& joint(const Model& model, const std::string& name) {
  return dynamic_cast<const Joint&>(*model.components_named(name).front());
}

State start(const System& system, const Environment& environment) {
  return TimeIntegration(system, environment, Scheme::generalized_alpha(0.8), system.start(0)).state();
}
State start(const ReadyModel& model) { return start(model.system, model.environment()); }

constexpr double g = 9.81;

/// A block slides down a plane that leans by `angle`, at 1 m/s.
std::string incline(double angle, const std::string& drives) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{block: {{position: [0, 0, 0], velocity: [{c}, 0, {s}]}}}}
elements: {{block: {{type: rigid_body, node: block, mass: 3, inertia: [0.1, 0.1, 0.1]}}}}
joints: {{guide: {{type: prismatic, nodes: [ground, block], axis: [{c}, 0, {s}], second_axis: [0, 1, 0]}}}}
)yaml",
                     fmt::arg("c", std::cos(angle)), fmt::arg("s", -std::sin(angle))) +
         drives;
}

std::string rub(double mu, const std::string& size) {
  return fmt::format("drives: {{rub: {{joint: guide, force: \"-{}*{}*tanh(guide.displacement.rate/0.01)\"}}}}\n", mu,
                     size);
}

}  // namespace

TEST_CASE("a block slides down a plane with the acceleration that friction on its guide's reaction leaves") {
  for (const double mu : {0.1, 0.5, 0.9})
    for (const double angle : {0.3, 1.2}) {
      const double expected = g * (std::sin(angle) - mu * std::cos(angle));
      CAPTURE(mu, angle);
      for (const char* size : {"sqrt(guide.reaction.x^2 + guide.reaction.y^2)", "abs(guide.reaction.y)"}) {
        const ReadyModel model(incline(angle, rub(mu, size)));
        const State at = start(model);
        const Vector3 along(std::cos(angle), 0, -std::sin(angle));
        // tanh(100) is 1; the search ends at steps of 1e-11.
        CHECK((model.node(at, "block").a - expected * along).norm() < 1e-10 * g);
        const State later = integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 0.05);
        CHECK((model.node(later, "block").v - (1 + 0.05 * expected) * along).norm() < 1e-8);
      }
      // A component that applies the same friction and reads multipliers.
      MechanismFile file = bielle::mechanism::read_mechanism_text(incline(angle, ""), "model.yaml");
      file.model.add(std::make_unique<ReactionFriction>("rub", joint(file.model, "guide"), mu),
                     Entry{Section::elements, "rub"}, Recorded::no);
      const System system(file.model);
      const State at = start(system, file.model.environment);
      CHECK_THAT(at.nodes[1].a.norm(), Catch::WithinRel(std::abs(expected), 1e-10));
    }
}

namespace {

/// A bead on a horizontal arm that is driven about a vertical axis, w(t) = 3 cos(5 t): the arm presses the bead
/// sideways by m (2 w v + w' r), which passes zero again and again; the weight is carried by the guide's other axis.
const char* const bead = R"yaml(
nodes: {arm: {position: [0, 0, 0], angular_velocity: [0, 0, 3]}, bead: {position: [0.5, 0, 0], angular_velocity: [0, 0, 3], velocity: [1, 1.5, 0]}}
elements:
  arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}
  bead: {type: rigid_body, node: bead, mass: 0.5, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  pivot: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [arm, bead], axis: [1, 0, 0], second_axis: [0, 1, 0]}
drives:
  turn: {joint: pivot, angle: "0.6*sin(5*t)"}
  rub: {joint: guide, force: "-0.5*abs(guide.reaction.x)*tanh(guide.displacement.rate/0.01)"}
)yaml";

}  // namespace

TEST_CASE("tangents that serve several iterations are safe across the kink of |N| at zero") {
  const ReadyModel model(bead);
  const auto run = [&](bool reuse, long& signs) {
    NewtonOptions options;
    options.tangent = reuse ? Tangent::reused : Tangent::renewed;
    TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                model.system.start(0), ConstraintForm::corrected, options);
    const double h = 2e-3;
    integration.start(h);
    std::vector<double> track;
    double before = 0;
    for (int k = 0; k < 1000; ++k) {
      integration.step(h);
      const Joint& guide = joint(model.file.model, "guide");
      const LocalState local(integration.state(), model.system.slots_of(guide), model.environment());
      const double N = guide.calc_reaction(local)[0];
      if (N * before < 0) ++signs;
      before = N;
      track.push_back(guide.coordinate(0, local).value);
    }
    return track;
  };
  long signs = 0, unused = 0;
  const std::vector<double> renewed = run(false, signs), reused = run(true, unused);
  REQUIRE(signs >= 4);
  // Newton's tolerance of 1e-9 of forces of some newtons on 0.5 kg, over 2 s: 1e-8 m.
  for (std::size_t k = 0; k < renewed.size(); ++k) REQUIRE(std::abs(renewed[k] - reused[k]) < 1e-8);
}

namespace {

// A rod leans on a slider that rubs on a rigid guide: Painleve's rod (P. Painleve, C. R. Acad. Sci. Paris 121 (1895)
// 112) with a guide that holds in both directions. Slider of mass M at x, its velocity v > 0; rod of mass m and inertia
// J about its centre, which stands at l (cos th, sin th) from the slider; friction -mu |N| on the slider, N the guide's
// force upwards. With c, s = cos th, sin th, w = th', kappa = m/(m + M):
//     forces on all, x:   M x'' + m (x'' - l s th'' - l c w^2) = -mu |N|
//     y:                  m (l c th'' - l s w^2) = N - (M + m) g
//     moments on the rod: D th'' = -kappa l s mu |N| + kappa m l^2 s c w^2 - m g l c,   D = J + m l^2 c^2 + kappa M l^2
//     s^2
// so that
//     N = b - mu k |N|,   k = kappa m l^2 s c / D,
//     b = (M + m) g - m l s w^2 + m l c (kappa m l^2 s c w^2 - m g l c) / D.
// N > 0: N = b/(1 + mu k); N < 0: N = b/(1 - mu k). For mu k < 1 exactly one of them has the sign that it assumes. For
// mu k > 1 (k > 0: the rod leans forward) both have where b > 0, and none where b < 0: b falls as the rod turns fast.
struct Rod {
  double mu, w;
  static constexpr double M = 0.1, m = 1, J = 0.02, l = 0.6, th = 1.1;
  static double c() { return std::cos(th); }
  static double s() { return std::sin(th); }
  static double kappa() { return m / (m + M); }
  static double D() { return J + m * l * l * c() * c() + kappa() * M * l * l * s() * s(); }
  static double k() { return kappa() * m * l * l * s() * c() / D(); }
  double b() const {
    return (M + m) * g - m * l * s() * w * w +
           m * l * c() * (kappa() * m * l * l * s() * c() * w * w - m * g * l * c()) / D();
  }
  double angular_acceleration(double N) const {
    return (-kappa() * l * s() * mu * std::abs(N) + kappa() * m * l * l * s() * c() * w * w - m * g * l * c()) / D();
  }
  std::string text() const {
    return fmt::format(R"yaml(
gravity: [0, -9.81, 0]
nodes:
  slider: {{position: [0, 0, 0], velocity: [1, 0, 0]}}
  rod: {{position: [{x}, {y}, 0], velocity: [{vx}, {vy}, 0], angular_velocity: [0, 0, {w}]}}
elements:
  slider: {{type: rigid_body, node: slider, mass: 0.1, inertia: [1e-3, 1e-3, 1e-3]}}
  rod: {{type: rigid_body, node: rod, mass: 1, inertia: [0.02, 0.02, 0.02]}}
joints:
  guide: {{type: prismatic, nodes: [ground, slider], axis: [1, 0, 0], second_axis: [0, 1, 0]}}
  pin: {{type: hinge, nodes: [slider, rod], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {{rub: {{joint: guide, force: "-{mu}*abs(guide.reaction.x)*tanh(guide.displacement.rate/0.01)"}}}}
)yaml",
                       fmt::arg("x", l * c()), fmt::arg("y", l * s()), fmt::arg("vx", 1 - l * s() * w),
                       fmt::arg("vy", l * c() * w), fmt::arg("w", w), fmt::arg("mu", mu));
  }
};

}  // namespace

TEST_CASE("below the critical coefficient a rod on a rubbing guide starts with the one solution of its equations") {
  for (const double part : {0.2, 0.7, 0.95, 0.999})
    for (const double w : {0.0, -3.0, 12.0}) {
      const Rod rod{part / Rod::k(), w};
      CAPTURE(rod.mu, w, rod.b());
      const ReadyModel model(rod.text());
      const State at = start(model);
      const double N = rod.b() / (1 + (rod.b() > 0 ? 1 : -1) * rod.mu * Rod::k());
      const Joint& guide = joint(model.file.model, "guide");
      const LocalState local(at, model.system.slots_of(guide), model.environment());
      // The guide's x axis points upwards. Near the critical coefficient rounding grows by 1/(1 - mu k).
      CHECK_THAT(guide.calc_reaction(local)[0], Catch::WithinRel(N, 1e-10 / (1 - part)));
      CHECK_THAT(model.node(at, "rod").Omegadot.z(), Catch::WithinRel(rod.angular_acceleration(N), 1e-10 / (1 - part)));
    }
  CHECK(Rod{0, 12}.b() < 0);
  CHECK(Rod{0, 0}.b() > 0);
}

TEST_CASE("above it the start is refused, by two solutions or by none") {
  for (const double part : {1.01, 1.5, 4.0}) {
    const Rod slow{part / Rod::k(), 0}, fast{part / Rod::k(), 12};
    CAPTURE(part);
    REQUIRE(slow.b() > 0);
    REQUIRE(fast.b() < 0);
    const auto message = [](const Rod& rod) {
      return message_of<bielle::ComputationError>([&] { start(ReadyModel(rod.text())); });
    };
    CHECK_THAT(message(slow), Catch::Contains("more than one solution") && Catch::Contains("Painleve"));
    CHECK_THAT(message(fast),
               Catch::Contains("no solution") && Catch::Contains("Painleve") && Catch::Contains("of joint '"));
  }
  // A rod that leans backwards is never jammed by its own weight: k < 0, and N > 0 grows by 1/(1 - mu |k|).
}

namespace {

std::string slider_crank(double mu) {
  return fmt::format(R"yaml(
gravity: [0, -9.81, 0]
nodes:
  crank: {{position: [0.1, 0, 0], velocity: [0, 2, 0], angular_velocity: [0, 0, 20]}}
  rod: {{position: [0.5, 0, 0]}}
  piston: {{position: [0.8, 0, 0]}}
elements:
  crank: {{type: rigid_body, node: crank, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  rod: {{type: rigid_body, node: rod, mass: 0.5, inertia: [1e-3, 0.01, 0.01]}}
  piston: {{type: rigid_body, node: piston, mass: 0.8, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  main: {{type: hinge, nodes: [ground, crank], axis: [0, 0, 1], position: [0, 0, 0]}}
  big: {{type: hinge, nodes: [crank, rod], axis: [0, 0, 1], position: [0.2, 0, 0]}}
  small: {{type: spherical, nodes: [rod, piston], position: [0.8, 0, 0]}}
  guide: {{type: cylindrical, nodes: [ground, piston], axis: [1, 0, 0], second_axis: [0, 1, 0]}}
drives:
  rub: {{joint: guide, force: "-{mu}*sqrt(guide.reaction.x^2 + guide.reaction.y^2 + 1e-6)*tanh(guide.displacement.rate/0.05)"}}
  bearing: {{joint: main, torque: "-{mu}*0.02*sqrt(main.reaction.x^2 + main.reaction.y^2 + 1e-6)*tanh(main.angle.rate/0.5)"}}
  pin: {{joint: big, torque: "-{mu}*0.01*sqrt(big.reaction.x^2 + big.reaction.y^2 + 1e-6)*tanh(big.angle.rate/0.5)"}}
)yaml",
                     fmt::arg("mu", mu));
}

/// In space, closed by four hinges: three constraints are redundant, and the friction is that of the reactions of
/// smallest norm.
std::string four_bar(double mu) {
  std::string text = R"yaml(
gravity: [0, -9.81, 0]
nodes:
  crank: {position: [0, 0.2, 0], velocity: [-1, 0, 0], angular_velocity: [0, 0, 5]}
  coupler: {position: [0.5, 0.7, 0]}
  rocker: {position: [1, 0.5, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.02, 0.001, 0.02]}
  coupler: {type: rigid_body, node: coupler, mass: 1, inertia: [0.1, 0.1, 0.1]}
  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [0.0833, 0.001, 0.0833]}
joints:
  a: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1], position: [0, 0, 0]}
  b: {type: hinge, nodes: [crank, coupler], axis: [0, 0, 1], position: [0, 0.4, 0]}
  c: {type: hinge, nodes: [coupler, rocker], axis: [0, 0, 1], position: [1, 1, 0]}
  d: {type: hinge, nodes: [ground, rocker], axis: [0, 0, 1], position: [1, 0, 0]}
drives:
)yaml";
  for (const char* name : {"a", "b", "c", "d"})
    text += fmt::format(
        "  f{0}: {{joint: {0}, torque: \"-{1}*0.02*sqrt({0}.reaction.x^2 + {0}.reaction.y^2 + "
        "1e-6)*tanh({0}.angle.rate/0.5)\"}}\n",
        name, mu);
  return text;
}

/// Returns a door on two hinges, one above the other.
std::string door(double mu, const std::string& swap = "") {
  const std::string upper = "  upper: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, 0.7]}\n",
                    lower = "  lower: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, -0.7]}\n";
  return "gravity: [0, 0, -9.81]\nnodes: {door: {position: [0.4, 0, 0], velocity: [0, 0.8, 0], angular_velocity: [0, "
         "0, 2]}}\n"
         "elements: {door: {type: rigid_body, node: door, mass: 20, inertia: [3, 4, 1]}}\njoints:\n" +
         (swap.empty() ? upper + lower : lower + upper) +
         fmt::format(
             "drives:\n"
             "  one: {{joint: upper, torque: \"-{0}*0.03*sqrt(upper.reaction.x^2 + "
             "upper.reaction.y^2)*tanh(upper.angle.rate/0.1)\"}}\n"
             "  two: {{joint: lower, torque: \"-{0}*0.03*sqrt(lower.reaction.x^2 + "
             "lower.reaction.y^2)*tanh(lower.angle.rate/0.1)\"}}\n",
             mu);
}

}  // namespace

TEST_CASE("ordinary friction raises no alarm") {
  for (const double mu : {0.1, 0.5, 0.9})
    for (const std::string& text :
         {slider_crank(mu), four_bar(mu), door(mu), incline(0.4, rub(mu, "abs(guide.reaction.y)")),
          Rod{mu * 0.9 / Rod::k(), 2}.text()}) {
      CAPTURE(mu, text);
      CHECK_NOTHROW(integrate(ReadyModel(text), Scheme::generalized_alpha(0.8), 1e-3, 0.3));
    }
}

namespace {

/// Returns the acceleration at the start of the door. Both hinges, H apart, carry half of the force m rho (-w^2, w',
/// g/rho); the weight's moment m g rho is carried by a pair of forces +-d and by the hinges' moments M_1 = M_2 = n:
///     H d + 2 n = m g rho,   the smallest 2 d^2 + 2 n^2/L^2:   d = m g rho H/(H^2 + 4 L^2)
double door_acceleration(double mu, double L) {
  constexpr double mass = 20, rho = 0.4, w = 2, H = 1.4, r = 0.03, inertia = 1 + mass * rho * rho;
  const double d = mass * g * rho * H / (H * H + 4 * L * L);
  double a = 0;  // |F| depends on it: contracts by mu r m rho/(I + m rho^2) = 0.05
  for (int k = 0; k < 30; ++k) {
    double torque = 0;
    for (const double side : {-1.0, 1.0})
      torque += mu * r * std::hypot(mass * rho * w * w / 2 + side * d, mass * rho * a / 2);
    a = -torque / inertia;
  }
  return a;
}

}  // namespace

TEST_CASE("friction on a door with two hinges is that of reactions of smallest norm, whatever the hinges' order") {
  for (const double mu : {0.2, 0.8})
    for (const char* swap : {"", "swapped"}) {
      const ReadyModel model(door(mu, swap));
      REQUIRE(model.system.set_aside().size() == 5);
      const double L = redundancy_arm(model.system, model.environment(), model.system.start(0));
      CAPTURE(mu, swap, L);
      // The smallest norm is found to 1e-8 or so.
      CHECK_THAT(model.node(start(model), "door").Omegadot.z(), Catch::WithinRel(door_acceleration(mu, L), 1e-8));
    }
  const auto at = [](const std::string& text) {
    const ReadyModel model(text);
    return integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 0.2).nodes[1];
  };
  const NodeState one = at(door(0.8)), other = at(door(0.8, "swapped"));
  // Newton's tolerance over 200 steps.
  CHECK((one.x - other.x).norm() < 1e-9);
  CHECK((one.Omega - other.Omega).norm() < 1e-8);
}

TEST_CASE("in statics, too, forces read the reactions of smallest norm, those of the state in hand") {
  // The spring's pull on the door grows with the upper hinge's reaction; only its own part is read.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {door: {position: [0.4, 0, 0]}}
elements: {door: {type: rigid_body, node: door, mass: 20, inertia: [3, 4, 1]}}
joints:
  upper: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, 0.7], stiffness: 50}
  lower: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, -0.7]}
drives: {pull: {joint: upper, torque: "0.1*lower.reaction.z"}}
)yaml";
  const ReadyModel model(text);
  REQUIRE(model.system.set_aside().size() == 5);
  State state = model.system.start(0);
  // Values of an earlier motion must not be used.
  state.reaction = VectorX::Constant(model.system.multipliers(), 1e3);
  Environment statics = model.environment();
  statics.statics = true;
  solve_statics(model.system, statics, 1, {}, state);
  // Each hinge carries half of the weight: 0.1 m g/2 = 50 angle.
  const Joint& upper = joint(model.file.model, "upper");
  const LocalState local(state, model.system.slots_of(upper), model.environment());
  CHECK_THAT(upper.coordinate(0, local).value, Catch::WithinRel(0.1 * 20 * g / 2 / 50, 1e-7));
}
