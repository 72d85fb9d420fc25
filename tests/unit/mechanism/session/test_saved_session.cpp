// A saved state is continued to the last bit, in the same session and in another one.
#include "swinging_arms.hpp"
#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::all_numbers;
using bielle::test::message_of;
using bielle::test::swing;
using bielle::test::swinging_arms;
using Catch::Contains;

TEST_CASE("a motion that is restored goes on as it did, to the last bit") {
  // The push begins at 0.1234 s: once after the saved state, once before it. Adaptive steps know their size and norm.
  for (const double tolerance : {0.0, 1e-6})
    for (const double time : {0.1, 0.15}) {
      CAPTURE(tolerance, time);
      Session session(swinging_arms().model);
      Motion motion = session.dynamics(swing(0.4, tolerance));
      motion.advance_to(time);
      const std::vector<double> saved = session.save(), there = all_numbers(session);
      motion.finish();
      const std::vector<double> end = all_numbers(session);
      CHECK(end != there);

      session.restore(saved);
      CHECK(all_numbers(session) == there);
      motion.finish();
      CHECK(all_numbers(session) == end);

      Session other(swinging_arms().model);
      Motion again = other.dynamics(swing(0.4, tolerance), saved);
      CHECK(all_numbers(other) == there);
      CHECK(again.energy().input == other.energy().input);
      again.finish();
      CHECK(all_numbers(other) == end);
    }
}

TEST_CASE("a hydraulic circuit goes on from what was saved, to the last bit") {
  // The load decides the pressures at the start; a valve with a spool, a relief valve that follows, an accumulator.
  const auto crane = [] {
    return read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {mass: {position: [0, 0, 1.2], fixed: [x, y, rx, ry, rz]}}
elements:
  load: {type: point_mass, node: mass, mass: 500}
  jack: {type: hydraulic_actuator, nodes: [ground, mass], piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5], ports: [a, b]}
hydraulics:
  fluid: {air_fraction: 0.01}
  volumes: {a: {volume: 1e-4}, b: {volume: 1e-4}, line: {volume: 1e-3, pressure: 1e7}}
  junctions: [before]
  supplies: {tank: {pressure: 101325}, pump: {to: line, from: tank, flow: 3e-4}}
  accumulators: {store: {at: line, gas_volume: 1e-3, precharge: 6e6}}
  lines:
    limit: {from: line, to: tank, relief: {pressure: 9e6, diameter: 6e-3, time_constant: 0.01}}
    filter: {from: line, to: before, orifice: {diameter: 5e-3}}
    valve: {ports: {P: before, T: tank, A: a, B: b}, servo_valve: {area: 5e-6, command: "0.5*step(t, 0, 0.05)", frequency: 40, damping: 0.7}}
)yaml",
                               "crane.yaml");
  };
  for (const double tolerance : {0.0, 1e-5}) {
    CAPTURE(tolerance);
    const MechanismFile file = crane(), same = crane();
    Session session(file.model), other(same.model);
    Motion motion = session.dynamics(swing(0.3, tolerance));
    motion.advance_to(0.1);
    const std::vector<double> saved = session.save(), there = all_numbers(session);
    motion.finish();
    const std::vector<double> end = all_numbers(session);
    CHECK(end != there);
    Motion again = other.dynamics(swing(0.3, tolerance), saved);
    CHECK(all_numbers(other) == there);
    again.finish();
    CHECK(all_numbers(other) == end);
  }
}

TEST_CASE("a session at rest is restored with its load, and statics go on alike") {
  const auto bent = [] {
    return Session(read_mechanism_text(R"yaml(
nodes: {a: {position: [0, 0, 0], fixed: true}, b: {position: [1, 0, 0]}}
elements:
  beam: {type: beam, nodes: [a, b], elements: 3, section: {circle: 0.01, young: 2.1e11, poisson: 0.3, density: 7800}}
loads: {p: {node: b, force: [0, 0, 400]}}
)yaml",
                                       "beam.yaml")
                       .model);
  };
  Session session = bent();
  session.on_step([](Session& at) {
    if (at.acting().load_factor == 0.5) at.stop();
  });
  StaticsOptions options;
  options.steps = 4;
  compute_statics(session, options);
  const std::vector<double> saved = session.save(), there = all_numbers(session);
  compute_statics(session, options);
  const std::vector<double> end = all_numbers(session);
  session.restore(saved);
  CHECK(all_numbers(session) == there);
  CHECK(session.loaded().factor == 0.5);
  compute_statics(session, options);
  CHECK(all_numbers(session) == end);
  Session other = bent();
  other.restore(saved);
  CHECK(all_numbers(other) == there);
  compute_statics(other, options);
  CHECK(all_numbers(other) == end);
}

TEST_CASE("restoring what was at rest ends a motion") {
  Session session(swinging_arms().model);
  session.assemble();
  const std::vector<double> saved = session.save(), there = all_numbers(session);
  Motion motion = session.dynamics(swing(0.1));
  motion.step();
  session.restore(saved);
  CHECK(all_numbers(session) == there);
  CHECK_THROWS_AS(motion.step(), std::logic_error);
}

TEST_CASE("what does not belong to the session is refused, and changes nothing") {
  Session session(swinging_arms().model);
  Motion motion = session.dynamics(swing(0.1));
  motion.advance_to(0.01);
  const std::vector<double> moving = session.save(), before = all_numbers(session);
  Session other(read_mechanism_text(R"yaml(
nodes: {a: {}}
elements: {a: {type: point_mass, node: a, mass: 1}}
)yaml",
                                    "stone.yaml")
                    .model);
  CHECK_THAT(message_of<InputError>([&] { session.restore(other.save()); }), Contains("not saved by a session"));
  CHECK_THAT(message_of<InputError>([&] { session.restore({}); }), Contains("not saved by a session"));
  std::vector<double> cut = moving;
  cut.pop_back();
  CHECK_THAT(message_of<InputError>([&] { session.restore(cut); }), Contains("not saved by a session"));
  CHECK(all_numbers(session) == before);
  CHECK(motion.step());
  Session at_rest(swinging_arms().model);
  CHECK_THAT(message_of<InputError>([&] { at_rest.restore(moving); }), Contains("is in motion"));
  const std::vector<double> resting = at_rest.save();
  CHECK_THAT(message_of<InputError>([&] { at_rest.dynamics(swing(0.1), resting); }), Contains("not in motion"));
}
