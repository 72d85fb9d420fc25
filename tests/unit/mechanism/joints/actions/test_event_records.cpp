// Records of events in formulas, in checkpoints and in the analyses that follow, and refused entries.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/describe_model.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::model_of;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_event_records {
namespace {

double value(const Session& session, const std::string& dataset) { return session.read(dataset)[0]; }

/// x = 0.1 sin(20 t) on a slide, with sections of the file.
std::string oscillator(const std::string& sections) {
  return R"yaml(
nodes: {mass: {position: [0, 0, 0], velocity: [2, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 0.5, inertia: [1, 1, 1]}}
joints: {slide: {type: prismatic, nodes: [ground, mass], axis: [1, 0, 0], stiffness: 200}}
)yaml" + sections;
}

std::vector<Event> events_of(const std::string& text, double duration, double h) {
  Session session = session_of(text);
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  Motion motion = session.dynamics(steps_of(duration, h));
  REQUIRE(motion.finish());
  return events;
}

}  // namespace

TEST_CASE("the name of an event is a measure: whether, when and how often it has happened") {
  Session session = session_of(oscillator(R"yaml(
measures: {so: "up", when: up.time, often: up.count, later: "if(t >= up.time, 1, 0)", slope: "min(max((t - up.time)/0.1, 0), 1)"}
events: {up: {when: slide.displacement, crosses: 0.05, direction: rising}}
)yaml"));
  Motion motion = session.dynamics(steps_of(10.5 * M_PI / 10, 0.001));
  motion.advance_to(0.02);
  for (const char* name : {"so", "often", "later", "slope"})
    CHECK(value(session, fmt::format("measures/{}", name)) == 0);
  CHECK(value(session, "measures/when") == 1e30);
  motion.finish();
  CHECK(value(session, "measures/so") == 1);
  CHECK(value(session, "measures/later") == 1);
  CHECK(value(session, "measures/slope") == 1);
  // The event occurs once in each of ten periods and in the half one: at pi/6 after each multiple of 2 pi.
  CHECK(value(session, "measures/often") == 11);
  CHECK(value(session, "measures/when") == Approx((20 * M_PI + M_PI / 6) / 20).epsilon(1e-3));
}

TEST_CASE("events occur once with actions, at each crossing without, and as the file says") {
  const auto count = [](const std::string& keys) {
    return events_of(oscillator("inputs: {gain: 1}\nevents: {up: {when: slide.displacement, crosses: 0.05, direction: "
                                "rising, " +
                                keys + "}}\n"),
                     5.5 * M_PI / 10, 0.002)
        .size();
  };
  CHECK(count("action: note") == 6);
  CHECK(count("action: restart") == 6);
  CHECK(count("once: true") == 1);
  CHECK(count("do: [{set: {gain: 2}}]") == 1);
  CHECK(count("do: [{set: {gain: 2}}], once: false") == 6);
}

TEST_CASE("an event after another one counts crossings from then on") {
  const std::vector<Event> events = events_of(oscillator(R"yaml(
events:
  low: {when: slide.displacement, crosses: -0.05, direction: rising, after: high}
  high: {when: slide.displacement, crosses: 0.08, direction: rising, once: true}
  beyond: {when: slide.displacement, crosses: 0.05, direction: rising, after: high, once: true}
)yaml"),
                                              2 * M_PI / 10, 0.001);
  REQUIRE(events.size() == 4);
  // phases of 20 t; `beyond` is exceeded already when `high` occurs, and is crossed a period later
  const double pi = M_PI, first = std::asin(0.8);
  const double phases[] = {first, 2 * pi - pi / 6, 2 * pi + pi / 6, 4 * pi - pi / 6};
  for (std::size_t k = 0; k < 4; ++k) CHECK(20 * events[k].time == Approx(phases[k]).epsilon(1e-3));
}

TEST_CASE("actions at one instant are done in the order of the file, whatever entries stand around them") {
  const auto gain = [](const std::string& sections) {
    Session session = session_of(oscillator("inputs: {gain: 1}\n" + sections));
    Motion motion = session.dynamics(steps_of(0.1, 0.003));
    motion.finish();
    return value(session, "measures/gain");
  };
  const std::string when = "when: slide.displacement, crosses: 0.05";
  CHECK(gain("events: {e: {" + when + ", do: [{set: {gain: gain + 2}}, {set: {gain: 3*gain}}]}}\n") == 9);
  CHECK(gain("events: {e: {" + when + ", do: [{set: {gain: 3*gain}}, {set: {gain: gain + 2}}]}}\n") == 5);
  const std::string a = "  a: {" + when + ", do: [{set: {gain: gain + 2}}]}\n",
                    b = "  b: {" + when + ", do: [{set: {gain: 3*gain}}]}\n";
  CHECK(gain("events:\n" + a + b) == 9);
  CHECK(gain("events:\n" + b + a) == 5);
}

namespace {

/// An arm that swings, is caught, let go again and gets another spring.
const char* const rich_entries[] = {R"yaml(
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [0.01, 0.1, 0.1]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
)yaml",
                                    R"yaml(
  shoulder: {type: hinge, nodes: [ground, upper], axis: [0, 1, 0], position: [0, 0, 0]}
  elbow: {type: hinge, nodes: [upper, lower], axis: [0, 1, 0], position: [1, 0, 0], locked: {from: {event: down}, to: {event: up}}}
)yaml"};
std::string rich(const std::string& events) {
  return std::string(
             "gravity: [0, 0, -9.81]\nnodes: {upper: {position: [0.5, 0, 0]}, lower: {position: [1.5, 0, 0]}}\n"
             "elements:") +
         rich_entries[0] +
         "  sling: {type: spring_damper, nodes: [ground, lower], stiffness: 20, damping: 1, length: 1, active: false}\n"
         "joints:" +
         rich_entries[1] + "inputs: {torque: 0}\ndrives: {motor: {joint: shoulder, torque: torque}}\nevents:\n" +
         events;
}
const std::string
    rich_down = "  down: {when: shoulder.angle, crosses: 1.2, do: [{set: {torque: 2*down.count}}]}\n",
    rich_up = "  up: {when: shoulder.angle.rate, direction: falling, after: down, do: [{activate: sling}]}\n",
    rich_end = "  end: {when: sling.force, crosses: 1, direction: rising, do: [{release: sling}, {lock: elbow}]}\n";

}  // namespace

TEST_CASE("a motion that is continued anywhere between events is the uninterrupted one, to the bit") {
  const std::string text = rich(rich_down + rich_up + rich_end);
  std::vector<Event> events;
  Session whole = session_of(text);
  whole.on_event([&](const Event& event) { events.push_back(event); });
  std::vector<std::vector<double>> saved;
  {
    Motion motion = whole.dynamics(steps_of(3, 0.005));
    for (double time = 0.25; time < 3; time += 0.25) {
      motion.advance_to(time);
      saved.push_back(whole.save());
    }
    motion.finish();
  }
  REQUIRE(events.size() >= 3);
  for (std::size_t k = 0; k < saved.size(); ++k) {
    Session other = session_of(text);
    Motion again = other.dynamics(steps_of(3, 0.005), saved[k]);
    // Pivots are chosen anew where a motion is saved: equal numbers need equal saves.
    for (std::size_t next = k + 1; next < saved.size(); ++next) {
      again.advance_to(0.25 * static_cast<double>(next + 1));
      (void)other.save();
    }
    again.finish();
    for (const char* name : {"joints/shoulder/coordinate", "joints/elbow/coordinate", "joints/shoulder/rate"})
      CHECK(value(other, name) == value(whole, name));
    CHECK(other.state().memory == whole.state().memory);
  }
}

TEST_CASE("the order of events in the file changes nothing") {
  const auto run = [](const std::string& events) {
    Session session = session_of(rich(events));
    Motion motion = session.dynamics(steps_of(3, 0.005));
    motion.finish();
    return Eigen::Vector3d(value(session, "joints/shoulder/coordinate"), value(session, "joints/elbow/coordinate"),
                           motion.energy().dissipation);
  };
  const Eigen::Vector3d first = run(rich_down + rich_up + rich_end);
  CHECK(run(rich_end + rich_up + rich_down).isApprox(first, 1e-10));
  CHECK(run(rich_up + rich_down + rich_end).isApprox(first, 1e-10));
}

TEST_CASE("what an event has released stays released in the analyses that follow, also at the very end of a motion") {
  const double time = GENERATE(0.1, 0.2, 5.0);  // within, at the end of the motion, never
  const std::string keys = GENERATE("", ", {stop: true}");
  CAPTURE(time, keys);
  Session session = session_of(fmt::format(R"yaml(
nodes: {{rotor: {{position: [0, 0, 0]}}}}
elements: {{rotor: {{type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}}}
joints: {{main: {{type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], stiffness: 50, rest: 0.1}}}}
drives: {{motor: {{joint: main, angle: "t"}}}}
events: {{go: {{when: t, crosses: {}, do: [{{release: motor}}{}]}}}}
)yaml",
                                           time, keys));
  {
    Motion motion = session.dynamics(steps_of(0.2, 0.01));
    motion.finish();
    CHECK(motion.stopped_by_event() == (!keys.empty() && time < 1));
  }
  if (time > 1) return;
  compute_statics(session, {});
  CHECK(value(session, "joints/main/coordinate") == Approx(0.1).epsilon(1e-9));
  const std::vector<Mode> modes = compute_modes(session, {}).found.modes;
  REQUIRE(!modes.empty());
  CHECK(modes.front().frequency() == Approx(std::sqrt(50 / 0.5) / (2 * M_PI)).epsilon(1e-9));
  Motion motion = session.dynamics(steps_of(0.1, 0.01));
  motion.finish();
  CHECK(value(session, "joints/main/coordinate") == Approx(0.1).epsilon(1e-8));
  CHECK(value(session, "joints/main/drive_force") == 0);
}

TEST_CASE("an event that causes itself again at once ends the run with a sentence") {
  // The force always pushes towards the place that is crossed.
  Session session = session_of(R"yaml(
nodes: {mass: {position: [0.01, 0, 0], velocity: [-1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements: {mass: {type: point_mass, node: mass, mass: 1}}
inputs: {side: 0}
loads: {push: {node: mass, force: ["-100*side", 0, 0]}}
events:
  left: {when: mass.velocity.x, crosses: 0, direction: rising, do: [{set: {side: 1}}], once: false}
  right: {when: mass.velocity.x, crosses: 0, direction: falling, do: [{set: {side: -1}}], once: false}
  begin: {when: mass.position.x, crosses: 0, do: [{set: {side: -1}}]}
)yaml");
  Motion motion = session.dynamics(steps_of(1, 0.01));
  CHECK_THAT(message_of<ComputationError>([&] { motion.finish(); }),
             Contains("occurs again and again") && Contains("hysteresis"));
}

TEST_CASE("events that cause each other without end at one instant end the run with a sentence") {
  Session session = session_of(oscillator(R"yaml(
inputs: {gain: 0}
measures: {watched: "gain + 0*slide.displacement"}
events:
  begin: {when: slide.displacement, crosses: 0.05, do: [{set: {gain: 2}}]}
  high: {when: watched, crosses: 1, direction: rising, do: [{set: {gain: 0}}], once: false}
  low: {when: watched, crosses: 0.5, direction: falling, do: [{set: {gain: 2}}], once: false}
)yaml"));
  Motion motion = session.dynamics(steps_of(0.2, 0.01));
  CHECK_THAT(message_of<ComputationError>([&] { motion.finish(); }), Contains("occurs again and again"));
}

TEST_CASE("events whose intervals shrink to nothing end the run with a sentence, at the instant of their limit") {
  // Two tanks that leak 0.5 each, and are filled with 0.75 in turns (K. H. Johansson et al., Syst. Control Lett. 38
  // (1999) 141): they lose 0.25 together, and are empty at t = (x + y) / 0.25 after endless switches.
  for (const double y : {1.0, 0.613}) {
    Session session = session_of(fmt::format(R"yaml(
inputs: {{u: 1}}
states:
  x: {{rate: "0.75*u - 0.5", start: 1}}
  y: {{rate: "0.75*(1-u) - 0.5", start: {}}}
events:
  a: {{when: x, crosses: 0, direction: falling, do: [{{set: {{u: 1}}}}], once: false}}
  b: {{when: y, crosses: 0, direction: falling, do: [{{set: {{u: 0}}}}], once: false}}
)yaml",
                                             y));
    Motion motion = session.dynamics(steps_of(12, 0.01));
    const std::string message = message_of<ComputationError>([&] { motion.finish(); });
    CHECK_THAT(message, Contains("occurs again and again"));
    CHECK_THAT(message, Contains(fmt::format("t = {:.6g} s", (1 + y) / 0.25)));
  }
}

TEST_CASE("kinematics do what needs no inertia, and refuse the rest") {
  const auto text = [](const std::string& action) {
    return "nodes: {arm: {position: [1, 0, 0]}}\n"
           "elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [1, 1, 1]}}\n"
           "joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}\n"
           "drives: {motor: {joint: main, angle: t}}\ninputs: {gain: 1}\n"
           "events: {there: {when: main.angle, crosses: 0.5, do: [" +
           action + "]}}\n";
  };
  KinematicsOptions options;
  options.duration = 1;
  options.step = 0.1;
  Session session = session_of(text("{set: {gain: 3}}, {stop: true}"));
  const KinematicsReport report = compute_kinematics(session, options);
  CHECK(report.stopped_by_event);
  CHECK(session.state().time == Approx(0.5).epsilon(1e-8));
  CHECK(value(session, "measures/gain") == 3);
  Session other = session_of(text("{lock: main}"));
  CHECK_THAT(message_of<InputError>([&] { compute_kinematics(other, options); }),
             Contains("event 'there' locks, releases or activates something"));
}

TEST_CASE("wrong actions are refused with the place and the nearest name") {
  const auto said = [](const std::string& events) {
    return message_of<InputError>([&] { model_of(oscillator("inputs: {gain: 1}\n" + events)); });
  };
  const auto action = [&](const std::string& text) {
    return said("events: {e: {when: slide.displacement, do: [" + text + "]}}\n");
  };
  CHECK(action("{lock: slide}, {release: slide}, {activate: slide}, {set: {gain: t}}, {stop: true}") ==
        "(nothing thrown)");
  CHECK_THAT(action("{lock: slid}"), Contains("no joint with coordinates, or valve, 'slid'") && Contains("'slide'"));
  CHECK_THAT(action("{lock: slide.angle}"), Contains("has no coordinate 'angle'"));
  CHECK_THAT(action("{unlock: 3}"), Contains("no joint"));
  CHECK_THAT(action("{release: slidee}"),
             Contains("there is no joint, element, drive, load or valve 'slidee'; did you mean"));
  CHECK_THAT(action("{release: mass}"), Contains("'mass' has inertia and is always active"));
  CHECK_THAT(action("{activate: mass}"), Contains("has inertia"));
  CHECK_THAT(action("{set: {gian: 2}}"), Contains("there is no input 'gian'; did you mean 'gain'"));
  CHECK_THAT(action("{set: {}}"), Contains("name of an input"));
  CHECK_THAT(action("{set: {gain: nan}}"), Contains("nan"));
  CHECK_THAT(action("{stop: false}"), Contains("expected `true`"));
  CHECK_THAT(action("{lok: slide}"), Contains("'lok' is not a key of an action of an event; did you mean 'lock'"));
  CHECK_THAT(action("{lock: slide, stop: true}"), Contains("one action in each item"));
  CHECK_THAT(action(""), Contains("do"));
  CHECK_THAT(action("stop"), Contains("expected"));
  CHECK_THAT(said("events: {e: {when: slide.displacement, after: e}}\n"), Contains("waits for itself"));
  CHECK_THAT(said("events: {e: {when: slide.displacement, after: f}}\n"), Contains("'f' among the events"));
  CHECK_THAT(said("events: {e: {when: slide.displacement, action: stop, do: [{stop: true}]}}\n"),
             Contains("does not go with `do`"));
  CHECK_THAT(said("loads: {p: {node: mass, force: [e.tim, 0, 0]}}\nevents: {e: {when: slide.displacement}}\n"),
             Contains("'e' has no 'tim'; did you mean 'time'"));
}

TEST_CASE("a check lists the actions of events, and inactive entries") {
  const std::string said = describe_model(read_mechanism_text(rich(rich_down + rich_up + rich_end), "model.yaml"));
  CHECK_THAT(said, Contains("sets 'torque' to 2*down.count") && Contains("after 'down', once") &&
                       Contains("releases 'sling', locks 'elbow'"));
  CHECK_THAT(said, Contains("angle locked from an event on until an event"));
  CHECK_THAT(said, Contains("released: it acts when an event activates it"));
}

}  // namespace test_event_records
