// `delay(x, T)` in formulas: one history for all that read it, its derivative, responses with delays, and messages.
#include <cmath>
#include <complex>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/measures/delayed_measure.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::model_of;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_delay_formula {

std::size_t delays_of(const std::string& text) {
  const Model model = model_of(text);
  std::size_t count = 0;
  for (const Member& member : model.members())
    count += dynamic_cast<const DelayedMeasure*>(member.component.get()) != nullptr ? 1 : 0;
  return count;
}

/// A motor with delayed feedback, 0.5 kg m^2.
const std::string servo = rotor(
    "parameters: {kp: 30, kd: 3, T: 0.03}\n"
    "inputs: {target: {start: 0, units: rad}}\n"
    "drives: {m: {joint: main, torque: \"kp*(target - delay(main.angle, T)) - kd*delay(main.angle.rate, 2*T)\"}}\n"
    "measures: {turned: main.angle, seen: \"delay(main.angle, T)\", twice: \"delay(delay(main.angle, T), T)\"}\n");

std::complex<double> response_of_servo(double frequency) {
  const std::complex<double> s(0, 2 * std::numbers::pi * frequency), z = std::exp(-0.03 * s);
  return 30.0 / (0.5 * s * s + 3.0 * s * z * z + 30.0 * z);
}

}  // namespace test_delay_formula
using namespace test_delay_formula;

TEST_CASE("formulas with the same measure and delay share its past") {
  CHECK(delays_of(servo) == 3);  // the angle, its rate, and the delayed angle
  CHECK(delays_of(rotor("measures: {a: \"delay(main.angle, 0.1) + delay( main.angle ,0.1)\"}\n"
                        "states: {b: {rate: \"delay(main.angle, 0.2/2)\"}}\n")) == 1);
  CHECK(delays_of(rotor("measures: {a: \"delay(main.angle, 0.1)\", b: \"delay(main.angle, 0.2)\"}\n")) == 2);
}

TEST_CASE("a delay may stand wherever a measure may, also with formulas of measures as operand") {
  Session session = session_of(
      rotor("parameters: {T: 0.1}\n"
            "states: {x: {rate: 1}, y: {filter: \"delay(x, T)\", time_constant: 0}, z: {sampled: \"delay(x, T)\", "
            "period: 0.25}, "
            "again: {delayed: \"delay(x, T)\", time: 0.1}}\n"
            "measures: {both: \"2*delay(2*x + t^2, T) + max(delay(x, T), 0)\", of_time: \"delay(sin(t), 2*T)\"}\n"
            "loads: {push: {node: rotor, moment: [0, 0, \"delay(x, T)\"]}}\n"
            "events: {late: {when: \"delay(x, T)\", crosses: 0.4}}\n"));
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  Motion motion = session.dynamics(steps_of(0.75, 0.05));
  motion.finish();
  const auto value = [&](const char* name) { return session.read(std::string("measures/") + name)[0]; };
  CHECK(value("y") == Approx(0.65).epsilon(1e-9));
  CHECK(value("z") == Approx(0.4).epsilon(1e-9));
  CHECK(value("again") == Approx(0.55).epsilon(1e-9));
  CHECK(value("both") == Approx(2 * (2 * 0.65 + 0.65 * 0.65) + 0.65).epsilon(1e-9));
  CHECK(value("of_time") == Approx(std::sin(0.55)).epsilon(1e-4));
  REQUIRE(events.size() == 1);
  CHECK(events[0].time == Approx(0.5).epsilon(1e-8));
  CHECK(session.measure("delay(x, 0.1)") == Approx(0.65).epsilon(1e-9));
  CHECK(session.measure("main.angle.rate") > 0);
}

TEST_CASE("the derivative of a delay is exact, whether it reaches into the step or not") {
  Session session = session_of(
      rotor("states: {x: {rate: \"cos(7*x)\", start: 0.1}}\n"
            "measures: {late: \"delay(x^2*main.angle.rate + delay(x, 0.02), 0.03)^2\", turned: main.angle.rate}\n"
            "drives: {m: {joint: main, torque: 1}}\n"));
  Motion motion = session.dynamics(steps_of(0.2, 0.01));
  motion.finish();
  const System& system = session.system();
  const Measure* measure = nullptr;
  for (const Member& member : session.model().members())
    if (member.component->name() == "late") measure = dynamic_cast<const Measure*>(member.component.get());
  REQUIRE(measure);
  const Slots& slots = system.slots_of(*measure);
  for (const double ahead : {0.02, 0.04, 0.06, 0.3}) {
    State state = session.state();
    state.time += ahead;
    state.first_order[0] += 0.1;
    const auto value = [&](double change) {
      State changed = state;
      changed.first_order[0] += change;
      return measure->value(LocalState(changed, slots, session.environment()));
    };
    MeasureGradient gradient;
    const double here = measure->calc(LocalState(state, slots, session.environment()), gradient);
    CHECK(here == Approx(value(0)).epsilon(1e-14));
    // The unknown x stands in the local layout once for each way to it; each is a derivative by x.
    const double found = gradient.position().sum();
    const double expected = (value(1e-5) - value(-1e-5)) / 2e-5;
    CAPTURE(ahead);
    CHECK(found == Approx(expected).epsilon(1e-7).margin(1e-12));
    CHECK((ahead < 0.025) == (found == 0));
  }
}

TEST_CASE("frequency responses contain delays exactly, those of rates and of delayed values too") {
  Session session = session_of(servo);
  FrequencyResponseOptions options;
  options.inputs = {{"target", -1, false, Vector3::Zero()}};
  options.outputs = {{"turned", -1, false, {}}, {"seen", -1, false, {}}, {"twice", -1, false, {}}};
  options.frequencies = {0, 0.3, 1.1, 4, 50};
  for (const bool moves : {false, true}) {
    if (moves) {
      session.set_input("target", 0.3);
      Motion motion = session.dynamics(steps_of(20, 0.01));
      motion.finish();
    }
    const FrequencyResponse found = compute_frequency_response(session, options);
    for (std::size_t k = 0; k < options.frequencies.size(); ++k) {
      CAPTURE(moves, options.frequencies[k]);
      const std::complex<double> H = response_of_servo(options.frequencies[k]),
                                 z = std::exp(
                                     std::complex<double>(0, -0.06 * std::numbers::pi * options.frequencies[k]));
      CHECK(std::abs(found.response[k](0, 0) - H) < 1e-9 * std::abs(H));
      CHECK(std::abs(found.response[k](1, 0) - H * z) < 1e-9 * std::abs(H));
      CHECK(std::abs(found.response[k](2, 0) - H * z * z) < 1e-9 * std::abs(H));
    }
  }
  CHECK(session.read("measures/turned")[0] == Approx(0.3).epsilon(1e-6));
}

TEST_CASE("a vibration in time has the amplitude and phase of the response with delays") {
  const double f = 1.1;
  Session session = session_of(rotor(
      "parameters: {kp: 30, kd: 3, T: 0.03}\n"
      "drives: {m: {joint: main, torque: \"kp*(sin(2*pi*1.1*t) - delay(main.angle, T)) - kd*delay(main.angle.rate, "
      "2*T)\"}}\n"
      "measures: {turned: main.angle}\n"));
  Motion motion = session.dynamics(steps_of(30 / f, 1 / f / 1000));
  motion.finish();
  // After whole periods the sine begins anew: the value is the imaginary part of the response.
  CHECK(session.read("measures/turned")[0] == Approx(response_of_servo(f).imag()).epsilon(1e-3));
}

TEST_CASE("modes are those without delays, and name these") {
  Session session = session_of(servo);
  const ModesReport report = compute_modes(session, {});
  REQUIRE_FALSE(report.found.modes.empty());
  CHECK(std::abs(report.found.modes[0].s) == Approx(std::sqrt(30 / 0.5)).epsilon(1e-9));
  CHECK(report.delays.size() == 3);
  CHECK(report.delays[0] == "delay(main.angle, 0.03)");
}

TEST_CASE("a prescribed motion of rigid parts has a past, one through states of equilibrium has none") {
  KinematicsOptions options;
  options.duration = 1;
  options.step = 0.005;
  Session rigid = session_of(
      rotor("drives: {m: {joint: main, angle: \"sin(3*t)\"}}\nmeasures: {late: \"delay(main.angle, 0.2)\"}\n"));
  compute_kinematics(rigid, options);
  CHECK(rigid.read("measures/late")[0] == Approx(std::sin(2.4)).epsilon(1e-6));
  Session elastic = session_of(R"yaml(
nodes: {a: {position: [0, 0, 0]}, b: {position: [0, 0, 0]}}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}, b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}}
joints:
  main: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  soft: {type: hinge, nodes: [a, b], axis: [0, 0, 1], stiffness: 100}
drives: {m: {joint: main, angle: "sin(3*t)"}}
measures: {late: "delay(soft.angle, 0.2)"}
)yaml");
  options.elastic = true;
  CHECK_THAT(bielle::test::message_of<InputError>([&] { compute_kinematics(elastic, options); }),
             Contains("1 delay (delay(soft.angle, 0.2))") && Contains("take a dynamic analysis"));
}

TEST_CASE("wrong delays in formulas are refused with a sentence") {
  const auto message = [](const std::string& torque) {
    return bielle::test::message_of<InputError>([&] {
      session_of(rotor("parameters: {T: 0.1, zero: 0}\ndrives: {m: {joint: main, torque: \"" + torque + "\"}}\n"));
    });
  };
  CHECK_THAT(message("delay(main.angle)"), Contains("drives.m.torque") && Contains("expected a measure and a time"));
  CHECK_THAT(message("delay(main.angle, T, 3)"), Contains("expected a measure and a time"));
  CHECK_THAT(message("delay(main.angle, 0)"), Contains("expected a delay greater than 0 s, found 0"));
  CHECK_THAT(message("delay(main.angle, zero)"), Contains("greater than 0 s"));
  CHECK_THAT(message("delay(main.angle, -T)"), Contains("found -0.1"));
  CHECK_THAT(message("delay(main.angle, 0/zero)"), Contains("the delay is constant"));
  CHECK_THAT(message("delay(main.angle, t)"), Contains("the delay is constant, a number or a formula of parameters"));
  CHECK_THAT(message("delay(main.angle, main.angle)"), Contains("the delay is constant"));
  CHECK_THAT(message("delay(main.angel, T)"), Contains("did you mean 'angle'"));
  CHECK_THAT(message("delay(T, T)"), Contains("a constant belongs to `parameters`"));
  CHECK_THAT(message("delay(main.angle, T"), Contains("the parenthesis of 'delay' at character 1 is not closed"));
  CHECK_THAT(message("delay(, T)"), Contains("an operand of 'delay' at character 1 is missing"));
  CHECK_THAT(message("delay()"), Contains("an operand of 'delay'"));
  CHECK_THAT(message("delay(main.angle, T).rate"), Contains("nothing can follow it"));
  CHECK_THAT(message("2*delay + 1"), Contains("'delay' at character 3"));
  const auto other = [](const std::string& text) {
    return bielle::test::message_of<InputError>([&] { session_of(rotor(text)); });
  };
  CHECK_THAT(other("measures: {delay: main.angle}\n"), Contains("'delay' means something in formulas already"));
  CHECK_THAT(other("measures: {a: \"1 + delay(b, 1)\", b: \"2*a\"}\n"), Contains("refers to itself"));
  CHECK_THAT(other("drives: {m: {joint: main, angle: \"delay(main.angle, 1)\"}}\n"), Contains("drives.m.angle"));
}

TEST_CASE("a delay of a formula's own variable is refused: it has no past") {
  const std::string text = R"yaml(
nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 2}
  s: {type: spring_damper, nodes: [ground, m], force: "100*delay(e, 0.1)"}
)yaml";
  CHECK_THAT(bielle::test::message_of<InputError>([&] { session_of(text); }),
             Contains("elements.s.force") && Contains("the past of 'e' is not known") && Contains("delay a measure"));
}
