// Belt drives that slip: the largest torque, the power that is lost, the time until both pulleys run together.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"

using namespace bielle::mechanism;
using bielle::test::move_to;

namespace test_belt_slip {
namespace {

constexpr double r = 0.1, distance = 0.5, EA = 2e4, T_0 = 300, mu = 0.3;

/// Returns two equal pulleys, hinged about z.
std::string drive(const std::string& friction, const std::string& more, double inertia = 0.01, double damping = 1e-3) {
  return fmt::format(R"yaml(
nodes: {{a: {{}}, b: {{position: [0.5, 0, 0]}}}}
elements:
  b1: {{type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  b2: {{type: rigid_body, node: b, mass: 1, inertia: [{0}, {0}, {0}]}}
joints:
  h1: {{type: hinge, nodes: [ground, a], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, b], axis: [0, 0, 1]}}
  belt: {{type: belt, nodes: [a, b], radii: [0.1, 0.1], axis: [0, 0, 1], EA: 2e4, pretension: 300, damping: {1},
         friction: {2}}}
)yaml",
                     inertia, damping, friction) +
         more;
}

struct Limit {
  double slack, tight, torque;
};

/// Returns the tensions when the belt slips: T_2 = k T_1, with T = EA E/(L - E) and the constant sum of both
/// elongations.
Limit limit_of(double k) {
  const double E_0 = T_0 * distance / (EA + T_0);
  const auto tension = [&](double E) { return EA * E / (distance - E); };
  double low = 0, high = E_0;  // by bisection
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (tension(E_0 + middle) < k * tension(E_0 - middle) ? low : high) = middle;
  }
  const double slack = tension(E_0 - low), tight = tension(E_0 + low);
  return {slack, tight, r * (tight - slack)};
}

}  // namespace
}  // namespace test_belt_slip

using namespace test_belt_slip;

TEST_CASE("an overloaded belt drive transmits the torque of the capstan equation") {
  const Limit limit = limit_of(std::exp(mu * M_PI));
  for (const double speed : {20.0, -20.0}) {
    CAPTURE(speed);
    const std::string text = drive(
        "[0.3, ~]", fmt::format("drives: {{motor: {{joint: h1, rate: {}}}, brake: {{joint: h2, angle: 0}}}}\n", speed));
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 0.5;
    options.stepping.size = 1e-3;
    Motion motion = session.dynamics(options);
    motion.finish();
    const double sign = speed > 0 ? 1 : -1;
    CHECK(session.read("joints/h1/drive_force")[0] == Approx(sign * limit.torque).epsilon(1e-6));
    CHECK(std::abs(session.read("joints/h2/drive_force")[0]) == Approx(limit.torque).epsilon(1e-6));
    const std::vector<double> T = session.read("joints/belt/tension");
    CHECK(std::max(T[0], T[1]) == Approx(limit.tight).epsilon(1e-6));
    CHECK(std::min(T[0], T[1]) == Approx(limit.slack).epsilon(1e-6));
    CHECK(std::abs(session.read("joints/belt/slip_velocity")[0]) == Approx(2).epsilon(1e-6));
    // All power of the motor is lost. The belt begins to slip within a step at the start; the error of this is less
    // than the loss of a step.
    const double lost = limit.torque * 20 * 0.5;
    CHECK(motion.energy_balance().totals().dissipation == Approx(lost).margin(limit.torque * 20 * 1e-3));
    CHECK(std::abs(motion.balance()) < limit.torque * 20 * 1e-3);
  }
}

TEST_CASE("a belt that slips while a flywheel starts loses the flywheel's kinetic energy") {
  // The constant torque M accelerates J to the speed of the motor in t = J w/M; M w t = J w^2, of which J w^2/2 is
  // lost.
  const Limit limit = limit_of(std::exp(mu * M_PI));
  const double J = 0.2, w = 40, together = J * w / limit.torque;
  const std::string text = drive("[0.3, ~]", fmt::format("drives: {{motor: {{joint: h1, rate: {}}}}}\n", w), J);
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  DynamicsOptions options;
  options.duration = 4 * together;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  motion.advance_to(0.5 * together);
  CHECK(session.read("joints/h2/rate")[0] == Approx(w / 2).epsilon(0.01));
  motion.finish();
  REQUIRE(!events.empty());
  const auto sticks = [](const Event& event) { return event.name.find("sticks on pulley 'a'") != std::string::npos; };
  const auto first = std::find_if(events.begin(), events.end(), sticks);
  REQUIRE(first != events.end());
  CHECK(first->time == Approx(together).epsilon(0.01));
  CHECK(session.read("joints/h2/rate")[0] == Approx(w).epsilon(0.01));
  CHECK(session.read("joints/belt/slips")[0] == 0);
  CHECK(motion.energy_balance().totals().dissipation == Approx(J * w * w / 2).epsilon(0.02));
  CHECK(std::abs(motion.balance()) < limit.torque * w * 1e-3);  // the loss of a step, at the start
}

TEST_CASE("the small pulley of a belt slips at its own wrap") {
  // Pulleys of 0.05 m and 0.2 m, 0.5 m apart: the wrap is pi - 2 asin(0.15/0.5).
  std::string text = drive("[0.3, ~]", "drives: {motor: {joint: h1, rate: 20}, brake: {joint: h2, angle: 0}}\n");
  text.replace(text.find("[0.1, 0.1]"), 10, "[0.05, 0.2]");
  const double wrap = M_PI - 2 * std::asin(0.3);
  move_to(text, 1e-3, 0.5, [&](const Session& session) {
    CHECK(session.read("joints/belt/wrap")[0] == Approx(wrap).epsilon(1e-9));
    const std::vector<double> T = session.read("joints/belt/tension");
    CHECK(std::max(T[0], T[1]) / std::min(T[0], T[1]) == Approx(std::exp(mu * wrap)).epsilon(1e-6));
    CHECK(std::abs(session.read("joints/belt/slip")[0]) == Approx(0.5).epsilon(0.02));
  });
}

TEST_CASE("statics lets a rope slip until friction holds it") {
  // The end b is pulled by 10 mm over a fixed drum: T_2 = k T_1 with T_1 = EA (E_0 + s)/(L - E_0 - s), and T_2
  // likewise.
  const std::string text = R"yaml(
nodes:
  a: {position: [-0.1, 0, -1], fixed: true}
  drum: {fixed: true}
  b: {position: [0.1, 0, -1], motion: {x: 0, y: 0, z: "-0.01", rx: 0, ry: 0, rz: 0}}
joints: {rope: {type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e5, pretension: 100, friction: 0.25}}
)yaml";
  const double stiffness = 1e5, E_0 = 100 / (stiffness + 100), k = std::exp(0.25 * M_PI);
  const auto tension = [&](double E, double L) { return stiffness * E / (L - E); };
  double low = 0, high = 0.01;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    (tension(E_0 + 0.01 - s, 1.01) > k * tension(E_0 + s, 1) ? low : high) = s;
  }
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  CHECK(session.read("joints/rope/slip")[0] == Approx(low).epsilon(1e-8));
  CHECK(session.read("joints/rope/tension")[0] == Approx(tension(E_0 + low, 1)).epsilon(1e-8));
  CHECK(session.read("joints/rope/tension")[1] == Approx(k * tension(E_0 + low, 1)).epsilon(1e-8));
}

TEST_CASE("a rope that is drawn to and fro over a drum dissipates the area of its loop") {
  // The work of the end over a period follows from the tension next to it; the balance is of first order in the step at
  // least.
  const auto run = [](double h) {
    const std::string text = R"yaml(
nodes:
  a: {position: [-0.1, 0, -1], fixed: true}
  drum: {fixed: true}
  b: {position: [0.1, 0, -1], motion: {x: 0, y: 0, z: "-0.004*sin(2*pi*t)", rx: 0, ry: 0, rz: 0}}
joints: {rope: {type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e5, pretension: 600, friction: 0.1}}
)yaml";
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 2;
    options.stepping.size = h;
    Motion motion = session.dynamics(options);
    motion.advance_to(1);
    const double before = motion.energy_balance().totals().dissipation;
    double work = 0, z = session.node("b").x.z(), T = session.read("joints/rope/tension")[1];
    while (motion.step()) {
      const double z_now = session.node("b").x.z(), T_now = session.read("joints/rope/tension")[1];
      work -= 0.5 * (T + T_now) * (z_now - z);
      z = z_now;
      T = T_now;
    }
    const double lost = motion.energy_balance().totals().dissipation - before;
    CHECK(work > 0.5);
    CHECK(lost == Approx(work).epsilon(0.01));
    return std::abs(motion.balance()) / lost;
  };
  const double coarse = run(5e-3), fine = run(1.25e-3);
  CHECK(coarse < 0.01);
  CHECK(coarse / fine > 4);
}

TEST_CASE("an interrupted motion with a slipping belt continues as if it had not been interrupted") {
  const std::string text = drive("[0.3, ~]", "drives: {motor: {joint: h1, rate: 40}}\n", 0.2);
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  DynamicsOptions options;
  options.duration = 0.4;
  options.stepping.size = 1e-3;
  Session whole(file.model), second(file.model);
  Motion motion = whole.dynamics(options);
  motion.advance_to(0.1);
  const std::vector<double> saved = whole.save();
  motion.finish();
  second.dynamics(options, saved).finish();
  for (const char* name : {"slip", "slip_velocity", "tension", "friction"}) {
    CAPTURE(name);
    CHECK(second.read(fmt::format("joints/belt/{}", name)) == whole.read(fmt::format("joints/belt/{}", name)));
  }
  CHECK(std::abs(whole.read("joints/belt/slip")[0]) > 0.01);
}
