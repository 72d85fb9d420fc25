// Events: the crossing of a value by a measure, its direction, its absence of side effects, and the end of a run.
#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::model_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace {

/// Returns a stone that falls from 2 m: z = 2 - 5 t^2, exactly so for the scheme.
std::string stone(const std::string& events) {
  return R"yaml(
gravity: [0, 0, -10]
nodes: {stone: {position: [0, 0, 2], fixed: [rx, ry, rz]}}
elements: {stone: {type: point_mass, node: stone, mass: 1}}
)yaml" + (events.empty() ? "" : "events:\n" + events);
}

std::vector<Event> events_of(const std::string& text, double duration, double h, double tolerance = 0) {
  Session session(model_of(text));
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  DynamicsOptions options = steps_of(duration, h);
  options.stepping.tolerance = tolerance;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  return events;
}

/// x = 0.1 sin(20 t) on a slide.
std::string oscillator(const std::string& events) {
  return R"yaml(
nodes: {mass: {position: [0, 0, 0], velocity: [2, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 0.5, inertia: [1, 1, 1]}}
joints: {slide: {type: prismatic, nodes: [ground, mass], axis: [1, 0, 0], stiffness: 200}}
)yaml" + (events.empty() ? "" : "events:\n" + events);
}

/// A chattering model: a force that is reversed whenever the velocity changes its sign, without any other law.
class Relay final : public Component {
 public:
  Relay(int node, double force) : Component("relay", "relay"), node_(node), force_(force) {}
  void declare(Declaration& declaration) const override {
    declaration.nodes = {node_};
    declaration.memory = {1};
    declaration.event_functions = {{"the velocity's change of sign"}};
  }
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override {
    r[0] += force_ * state.memory()[0];
  }
  void add_tangent(const LocalState&, LocalTangent&) const override {}
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override {
    values[0] = state.node(0).v.x();
  }
  void begin_branch(const LocalState&, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override {
    if (!crossed.empty()) memory[0] = -memory[0];
  }

 private:
  int node_;
  double force_;
};

/// A force that begins in the first accepted step beyond a place, which the component detects by itself.
class LateForce final : public Component {
 public:
  LateForce(int node, double place, double force)
      : Component("late_force", "late"), node_(node), place_(place), force_(force) {}
  void declare(Declaration& declaration) const override {
    declaration.nodes = {node_};
    declaration.memory = {0};
  }
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override {
    r[0] -= force_ * state.memory()[0];
  }
  void add_tangent(const LocalState&, LocalTangent&) const override {}
  bool leaves_branch(const LocalState& state) const override { return state.memory()[0] == 0 && beyond(state); }
  void begin_branch(const LocalState& state, std::span<const int>, Eigen::Ref<VectorX> memory) const override {
    if (beyond(state)) memory[0] = 1;
  }

 private:
  bool beyond(const LocalState& state) const { return state.node(0).x.x() > place_; }
  int node_;
  double place_, force_;
};

Model slider(double speed) {
  Model model;
  Node node;
  node.name = "slider";
  node.velocity = {speed, 0, 0};
  const int at = model.add_node(node);
  model.add(std::make_unique<RigidBody>("rigid_body", "slider", at, 500.0 * sphere(0.1)),
            Entry{Section::elements, "slider"});
  return model;
}

}  // namespace

TEST_CASE("an event stands where the measure crosses its value") {
  const double h = GENERATE(0.1, 0.0123, 1e-3), tolerance = GENERATE(0.0, 1e-6);
  const std::vector<Event> events = events_of(stone("  low: {when: stone.position.z, crosses: 1.3}\n"
                                                    "  fast: {when: stone.velocity.z, crosses: -4.2}\n"
                                                    "  later: {when: \"t - 0.5\"}\n"
                                                    "  both: {when: \"stone.position.z + t\", crosses: 1.7}\n"),
                                              0.6, h, tolerance);
  CAPTURE(h, tolerance);
  REQUIRE(events.size() == 4);
  const double sum = (1 + std::sqrt(1 + 4 * 5 * 0.3)) / 10;  // 5 t^2 - t = 0.3
  const std::pair<const char*, double> wanted[] = {
      {"event 'low'", std::sqrt(0.7 / 5)}, {"event 'both'", sum}, {"event 'fast'", 0.42}, {"event 'later'", 0.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto found =
        std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.name == wanted[k].first; });
    REQUIRE(found != events.end());
    INFO(wanted[k].first);
    // Events are less than 1e-10 of a step late; adaptive steps grow up to the rest of 0.6 s.
    CHECK(found->time == Approx(wanted[k].second).margin(1e-10 * (tolerance > 0 ? 0.6 : h) + 1e-14).epsilon(0));
    if (k > 0) CHECK(events[k].time >= events[k - 1].time);
  }
}

TEST_CASE("directions: rising, falling, both; what begins on its value has not crossed it") {
  const std::vector<Event> events =
      events_of(oscillator("  up: {when: slide.displacement, crosses: 0.05, direction: rising}\n"
                           "  down: {when: slide.displacement, crosses: 0.05, direction: falling}\n"
                           "  any: {when: slide.displacement, crosses: 0.05}\n"
                           "  middle: {when: slide.displacement}\n"),
                0.5, 1e-3);
  const double pi = M_PI;
  const std::map<std::string, std::vector<double>> wanted = {
      // phases 20 t up to 10 rad
      {"event 'up'", {pi / 6, 2 * pi + pi / 6}},
      {"event 'down'", {pi - pi / 6, 3 * pi - pi / 6}},
      {"event 'any'", {pi / 6, pi - pi / 6, 2 * pi + pi / 6, 3 * pi - pi / 6}},
      {"event 'middle'", {pi, 2 * pi, 3 * pi}}};
  for (const auto& [name, phases] : wanted) {
    std::vector<double> times;
    for (const Event& event : events)
      if (event.name == name) times.push_back(event.time);
    INFO(name);
    REQUIRE(times.size() == phases.size());
    // (omega h)^2/12 = 3.4e-5 of the phase.
    for (std::size_t k = 0; k < times.size(); ++k) CHECK(20 * times[k] == Approx(phases[k]).epsilon(5e-5));
  }
}

TEST_CASE("events in one step, at one time as well, are all noted, each at its time") {
  const std::vector<Event> events = events_of(stone("  a: {when: stone.position.z, crosses: 1}\n"
                                                    "  b: {when: stone.position.z, crosses: 0.99}\n"
                                                    "  c: {when: \"2*stone.position.z\", crosses: 2}\n"
                                                    "  d: {when: stone.velocity.z, crosses: -4.5}\n"),
                                              0.6, 0.2);
  REQUIRE(events.size() == 4);
  const auto time_of = [&](const std::string& name) {
    for (const Event& event : events)
      if (event.name == "event '" + name + "'") return event.time;
    return 0.0;
  };
  CHECK(time_of("a") == Approx(std::sqrt(0.2)).epsilon(1e-10));
  CHECK(time_of("c") == Approx(std::sqrt(0.2)).epsilon(1e-10));
  CHECK(time_of("b") == Approx(std::sqrt(1.01 / 5)).epsilon(1e-10));
  CHECK(time_of("d") == Approx(0.45).epsilon(1e-10));
}

TEST_CASE("a noted event leaves the motion as it is") {
  const auto end = [](const std::string& events, double h) {
    Session session(model_of(oscillator(events)));
    Motion motion = session.dynamics(steps_of(0.5, h));
    REQUIRE(motion.finish());
    return session.node("mass").x.x();
  };
  const std::string events =
      "  up: {when: slide.displacement, crosses: 0.05}\n  turn: {when: slide.displacement.rate}\n";
  for (const double h : {2e-3, 5e-4}) {
    const double without = end("", h), error = without - 0.1 * std::sin(10.0);
    CHECK(end(events, h) == without);
    CHECK(std::abs(error) < 0.1 * 10 * 400 * h * h);
    // Steps that are divided have errors of order 2 that are no larger.
    const std::string divided = "  up: {when: slide.displacement, crosses: 0.05, action: restart}\n";
    CHECK(std::abs(end(divided, h) - without) < 0.2 * std::abs(error));
  }
}

TEST_CASE("a step that ends on an event may be of any size, and leaves velocities and accelerations as they are") {
  // z = 2 - 5 t^2, a = -10 m/s^2 everywhere, and the joint's reaction is the horizontal force of 3 N.
  for (const double away : {0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 5e-3})
    for (const double time : {0.1 - away, 0.1 + away, 0.2 - away}) {  // 0.2 s is the end as well
      for (const char* action : {"restart", "stop"}) {
        CAPTURE(away, time, action);
        Session session(model_of(fmt::format(R"yaml(
gravity: [0, 0, -10]
nodes: {{stone: {{position: [0, 0, 2]}}}}
elements: {{stone: {{type: rigid_body, node: stone, mass: 1, inertia: [1, 1, 1]}}}}
joints: {{path: {{type: prismatic, nodes: [ground, stone], axis: [0, 0, 1]}}}}
loads: {{wind: {{node: stone, force: [3, 0, 0]}}}}
events: {{e: {{when: "t + 0*stone.position.x", crosses: {:.17g}, action: {}}}}}
)yaml",
                                             time, action)));
        double worst = 0;
        session.on_step([&](Session&) {
          const NodeState& stone = session.node("stone");
          const double t = session.time();
          worst = std::max({worst, std::abs(stone.a.z() + 10) / 10, std::abs(stone.v.z() + 10 * t) / 10,
                            std::abs(stone.x.z() - 2 + 5 * t * t),
                            std::abs(std::abs(session.read("joints/path/reaction_inertial")[0]) - 3) / 3});
        });
        Motion motion = session.dynamics(steps_of(0.2, 0.01));
        CHECK(motion.finish());
        CHECK(worst < 1e-6);
        if (std::string(action) == "stop" && time < 0.2)
          CHECK(motion.time() == Approx(time).margin(1e-12).epsilon(0));
        else if (std::string(action) == "restart")
          CHECK(motion.time() == 0.2);
      }
    }
}

TEST_CASE("an event that stops ends the run there, with a last row") {
  Session session(
      model_of(stone("  landed: {when: stone.position.z, crosses: 1.3, direction: falling, action: stop}\n")));
  MemorySink sink(session.model());
  session.add_sink(sink);
  session.begin_analysis("dynamic");
  Motion motion = session.dynamics(steps_of(5, 0.1));
  CHECK(motion.finish());
  CHECK(motion.done());
  const double landed = std::sqrt(0.7 / 5);
  CHECK(motion.time() == Approx(landed).epsilon(1e-10));
  CHECK(!motion.step());
  session.end_analysis();
  const std::vector<double> time = sink.read(0, "time");
  REQUIRE(time.size() == 5);  // 0, 0.1, 0.2, 0.3, and the last
  CHECK(time.back() == motion.time());
  CHECK(sink.read(0, "nodes/stone/position").back() == Approx(1.3).epsilon(1e-9));
  REQUIRE(sink.analyses()[0].events.size() == 1);
  CHECK(sink.analyses()[0].events[0].time == motion.time());
  // A following motion starts there.
  Motion further = session.dynamics(steps_of(0.1, 0.01));
  CHECK(further.finish());
  CHECK(session.time() == Approx(landed + 0.1).epsilon(1e-10));
  CHECK(session.node("stone").x.z() == Approx(2 - 5 * session.time() * session.time()).epsilon(1e-11));
}

TEST_CASE("an event at the start that stops the run leaves the row of the start alone") {
  for (const bool times : {false, true}) {
    CAPTURE(times);
    Session session(model_of(
        stone("  high: {when: stone.position.z, crosses: 2, direction: rising, at_start: true, action: stop}\n")));
    MemorySink sink(session.model());
    session.add_sink(sink);
    Recording recording;
    if (times) recording.times = {0.05, 0.2};
    session.set_recording(recording);
    session.begin_analysis("dynamic");
    Motion motion = session.dynamics(steps_of(1, 0.1));
    CHECK(motion.finish());
    CHECK(motion.time() == 0);
    session.end_analysis();
    CHECK(sink.read(0, "time") == std::vector<double>{0});
    CHECK(sink.analyses()[0].events.size() == 1);
  }
}

TEST_CASE("an event is noted where its measure jumps over its value") {
  // A lock stops the mass; its velocity is 0.9 m/s just before.
  std::string text = oscillator(
      "  slow: {when: slide.displacement.rate, crosses: 0.5, direction: falling}\n"
      "  never: {when: slide.displacement.rate, crosses: 0.5, direction: rising}\n");
  text.replace(text.find("stiffness: 200"), 14, "locked: {from: 0.25}");
  const std::vector<Event> events = events_of(text, 0.4, 0.01);
  REQUIRE(events.size() == 1);
  CHECK(events[0].name == "event 'slow'");
  CHECK(events[0].time == 0.25);
}

TEST_CASE("what chatters is told so") {
  Model model = slider(0.3);
  model.add(std::make_unique<Relay>(*model.find_node("slider"), 4), Entry{Section::elements, "relay"});
  Session session(model);
  Motion motion = session.dynamics(steps_of(1, 0.01));
  const std::string message = message_of<ComputationError>([&] { motion.finish(); });
  CHECK_THAT(message, Contains("element 'relay': the velocity's change of sign occurs again and again"));
  CHECK_THAT(message, Contains("hysteresis"));
  // It stands where the velocity has come to zero.
  const double a = 4 / (500.0 * sphere(0.1)).mass;
  CHECK(motion.time() == Approx(0.3 / a).epsilon(1e-6));
}

TEST_CASE("a component that leaves its branch starts the motion anew at the end of the step") {
  Model model = slider(1);
  const double mass = (500.0 * sphere(0.1)).mass, force = 6;
  model.add(std::make_unique<LateForce>(*model.find_node("slider"), 0.437, force), Entry{Section::elements, "late"});
  Session session(model);
  Motion motion = session.dynamics(steps_of(1, 0.05));
  REQUIRE(motion.finish());
  // It is beyond at 0.45; constant forces on either side are exact for the scheme, started anew between.
  const double a = force / mass, s = 1 - 0.45;
  CHECK(session.node("slider").v.x() == Approx(1 + a * s).epsilon(1e-11));
  CHECK(session.node("slider").x.x() == Approx(1 + a * s * s / 2).epsilon(1e-11));
}
