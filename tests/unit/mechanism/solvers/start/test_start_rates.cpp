// Rates of coordinates at the start, against closed forms.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/four_bar.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/rough_drawing.hpp"

using namespace bielle::mechanism;
using bielle::test::FourBar;
using bielle::test::list;
using bielle::test::message_of;

namespace test_start_rates {
namespace {

/// The four-bar as it fits; nodes at the ends of the links.
std::string four_bar(const std::string& crank_keys, const std::string& rocker_keys, const std::string& more = "") {
  const FourBar bar = bielle::test::released_four_bar();
  const auto body = [](const std::string& name) {
    return fmt::format("  {}: {{type: rigid_body, node: {}, mass: 1, inertia: [0.01, 0.02, 0.02]}}\n", name, name);
  };
  const auto hinge = [](const std::string& name, const std::string& nodes, const Vector3& at, const std::string& keys) {
    return fmt::format("  {}: {{type: hinge, nodes: [{}], position: {}, axis: [0, 0, 1]{}}}\n", name, nodes, list(at),
                       keys);
  };
  return fmt::format(
             "nodes: {{crank: {{position: {}}}, coupler: {{position: {}}}, rocker: {{position: {}}}}}\nelements:\n",
             list(bar.A), list(bar.B), list(bar.D)) +
         body("crank") + body("coupler") + body("rocker") + "joints:\n" +
         hinge("a", "ground, crank", bar.A, crank_keys) + hinge("b", "crank, coupler", bar.B, "") +
         hinge("c", "coupler, rocker", bar.C, "") + hinge("d", "ground, rocker", bar.D, rocker_keys) + more;
}

/// Returns the rocker's rate over the crank's: a sin(t2 - t3) / (c sin(t4 - t3)), t2, t3, t4 the directions of crank,
/// coupler, rocker.
double rate_ratio() {
  const FourBar bar = bielle::test::released_four_bar();
  const auto direction = [](const Vector3& from, const Vector3& to) {
    return std::atan2(to.y() - from.y(), to.x() - from.x());
  };
  const double t2 = direction(bar.A, bar.B), t3 = direction(bar.B, bar.C), t4 = direction(bar.D, bar.C);
  return 0.3 * std::sin(t2 - t3) / (0.7 * std::sin(t4 - t3));
}

}  // namespace

TEST_CASE("the start rate of the crank sets the whole four-bar in motion") {
  const char* dynamic = "analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]\n";
  Session session(read_mechanism_text(four_bar(", start_rate: {angle: 4}", "", dynamic), "bar.yaml").model);
  DynamicsOptions options;
  options.duration = 0.01;
  options.stepping.size = 1e-3;
  const Motion motion = session.dynamics(options);  // without an `assembly` before it
  CHECK(session.read("joints/a/rate")[0] == Approx(4).epsilon(1e-12));
  CHECK(session.read("joints/d/rate")[0] == Approx(4 * rate_ratio()).epsilon(1e-11));
}

TEST_CASE("the start rate of the rocker is kept exactly, whatever velocities the file gives to nodes") {
  std::string text = four_bar("", ", start_rate: -2");
  text.replace(text.find("coupler: {"), 10, "coupler: {velocity: [1, 2, 3], angular_velocity: [4, 5, 6], ");
  Session session(read_mechanism_text(text, "bar.yaml").model);
  session.assemble();
  CHECK(session.read("joints/d/rate")[0] == Approx(-2).epsilon(1e-12));
  CHECK(session.read("joints/a/rate")[0] == Approx(-2 / rate_ratio()).epsilon(1e-11));
}

TEST_CASE("what start rates leave open keeps its velocities as the kinetic energy weighs them") {
  // A mass m slides along x on a cart M, which slides along x. Relative rate r: least change of m v^2 + M V^2 from 3
  // and 1.
  Session session(read_mechanism_text(R"yaml(
nodes: {cart: {velocity: [1, 0, 0]}, slider: {position: [0.2, 0, 0], velocity: [3, 0, 0]}}
elements:
  cart: {type: rigid_body, node: cart, mass: 4, inertia: [1, 1, 1]}
  slider: {type: rigid_body, node: slider, mass: 1, inertia: [1, 1, 1]}
joints:
  rail: {type: prismatic, nodes: [ground, cart], axis: [1, 0, 0]}
  guide: {type: prismatic, nodes: [cart, slider], axis: [1, 0, 0], start_rate: 0.5}
)yaml",
                                      "cart.yaml")
                      .model);
  const StartReport report = session.assemble();
  // The momentum stays 7: (M + m) V + m r = 7.
  CHECK(session.node("cart").v.x() == Approx((7 - 0.5) / 5).epsilon(1e-12));
  CHECK(session.node("slider").v.x() == Approx((7 - 0.5) / 5 + 0.5).epsilon(1e-12));
  CHECK(report.velocity_change == Approx(3 - 1.8).epsilon(1e-12));
}

TEST_CASE("angular velocities that joints take away are reported, those that drives give are not") {
  const auto angular_change = [](const std::string& keys) {
    Session session(read_mechanism_text("nodes: {wheel: {" + keys +
                                            "}}\nelements: {wheel: {type: rigid_body, node: wheel, mass: 1, inertia: "
                                            "[1, 2, 3]}}\njoints: {axle: {type: hinge, nodes: [ground, wheel], axis: "
                                            "[0, 0, 1]}}\ndrives: {motor: {joint: axle, rate: 5}}\n",
                                        "wheel.yaml")
                        .model);
    return session.assemble().angular_change;
  };
  CHECK(angular_change("angular_velocity: [7, 0, 5]") == Approx(7).epsilon(1e-12));
  CHECK(angular_change("angular_velocity: [0, 0, 2]") == Approx(3).epsilon(1e-12));
  CHECK(angular_change("angular_velocity: [0, 0, 5]") == Approx(0).margin(1e-12));
  CHECK(angular_change("position: [0, 0, 0]") == 0);
}

TEST_CASE("start rates that follow from others have to agree with them") {
  const std::string agreeing = fmt::format(", start_rate: {:.17g}", 4 * rate_ratio());
  Session session(read_mechanism_text(four_bar(", start_rate: 4", agreeing), "bar.yaml").model);
  const StartReport report = session.assemble();
  CHECK(report.following == std::vector<std::string>{"angle of joint 'd'"});
  CHECK(session.read("joints/a/rate")[0] == Approx(4).epsilon(1e-12));

  const auto refusal = [](const std::string& text) {
    return message_of<bielle::ComputationError>(
        [&] { Session(read_mechanism_text(text, "bar.yaml").model).assemble(); });
  };
  const std::string contradiction = refusal(four_bar(", start_rate: 4", ", start_rate: 1"));
  CHECK_THAT(contradiction, Catch::Contains("the start rate 1 rad/s of angle of joint 'd' contradicts"));
  CHECK_THAT(contradiction, Catch::Contains(fmt::format("which make it {:.6g} rad/s", 4 * rate_ratio())));
  const std::string driven = "drives: {m: {joint: a, rate: \"3\"}}\n";
  CHECK_THAT(refusal(four_bar("", ", start_rate: 1", driven)),
             Catch::Contains(fmt::format("which make it {:.6g} rad/s", 3 * rate_ratio())));
  CHECK_NOTHROW(Session(read_mechanism_text(
                            four_bar("", fmt::format(", start_rate: {:.17g}", 3 * rate_ratio()), driven), "bar.yaml")
                            .model)
                    .assemble());
}

TEST_CASE("start values and rates hold where the first analysis starts, and not again") {
  const std::string pendulum = R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [0, 0, -1]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {pivot: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0], start: 0.4, start_rate: 2}}
)yaml";
  Session session(read_mechanism_text(pendulum, "pendulum.yaml").model);
  DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 1e-3;
  double angle = 0, rate = 0;
  {
    Motion motion = session.dynamics(options);
    CHECK(session.read("joints/pivot/coordinate")[0] == Approx(0.4).epsilon(1e-13));
    CHECK(session.read("joints/pivot/rate")[0] == Approx(2).epsilon(1e-13));
    motion.finish();
    angle = session.read("joints/pivot/coordinate")[0];
    rate = session.read("joints/pivot/rate")[0];
  }
  CHECK(angle > 0.5);
  const Motion second = session.dynamics(options);
  CHECK(session.read("joints/pivot/coordinate")[0] == Approx(angle).epsilon(1e-12));
  CHECK(session.read("joints/pivot/rate")[0] == Approx(rate).epsilon(1e-5));  // the scheme's start adds a term of h^2
}

TEST_CASE("an angle that starts beyond half a turn is counted from there") {
  Session session(read_mechanism_text(R"yaml(
nodes: {wheel: {}}
elements: {wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1], start: {angle: 7.5}}}
)yaml",
                                      "wheel.yaml")
                      .model);
  session.assemble();
  CHECK(session.read("joints/axle/coordinate")[0] == Approx(7.5).epsilon(1e-13));
  CHECK((session.node("wheel").R - exp_so3(Vector3(0, 0, 7.5))).norm() < 1e-12);
}

TEST_CASE("a lock that is closed from the beginning holds the start value") {
  Session session(read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {pivot: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0], start: 0.4, locked: {to: 1}}}
)yaml",
                                      "lock.yaml")
                      .model);
  DynamicsOptions options;
  options.duration = 0.01;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  motion.finish();
  CHECK(session.read("joints/pivot/coordinate")[0] == Approx(0.4).epsilon(1e-12));
}

}  // namespace test_start_rates
