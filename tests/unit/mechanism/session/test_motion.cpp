// Motions step by step: callbacks, stops, intermediate states, and the end of a motion.
#include <stdexcept>

#include "swinging_arms.hpp"
#include <catch2/catch.hpp>

#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::all_numbers;
using bielle::test::swing;
using bielle::test::swinging_arms;

TEST_CASE("a motion goes step by step, to a time, or to its end, and it is the same motion") {
  for (const double tolerance : {0.0, 1e-6}) {
    Session by_steps(swinging_arms().model), by_times(swinging_arms().model), at_once(swinging_arms().model);
    Motion steps = by_steps.dynamics(swing(0.4, tolerance)), times = by_times.dynamics(swing(0.4, tolerance)),
           whole = at_once.dynamics(swing(0.4, tolerance));
    while (steps.step()) {
    }
    CHECK(times.advance_to(0.2));
    CHECK(times.time() >= 0.2 - 1e-12);
    CHECK(times.advance_to(0.4));
    CHECK(whole.finish());
    CHECK(steps.done());
    CHECK_FALSE(steps.step());
    CHECK_FALSE(steps.advance_to(1));
    CHECK(steps.log().steps == whole.log().steps);
    CHECK(all_numbers(by_steps) == all_numbers(at_once));
    CHECK(all_numbers(by_times) == all_numbers(at_once));
  }
}

TEST_CASE("a motion ends on times of its grid exactly, and knows what is in between") {
  Session session(swinging_arms().model);
  DynamicsOptions options = swing(0.1);
  options.stepping.size = 0.01;
  Motion motion = session.dynamics(options);
  CHECK(motion.advance_to(0.05));
  CHECK(motion.time() == Approx(0.05).epsilon(1e-12));
  CHECK(motion.advance_to(0.052));
  CHECK(motion.time() == Approx(0.06).epsilon(1e-12));
  CHECK(motion.interpolated(0.052).time == 0.052);
}

TEST_CASE("callbacks see each step and stop the motion, which may go on") {
  Session session(swinging_arms().model), undisturbed(swinging_arms().model);
  std::vector<double> times;
  session.on_step([&](Session& at) {
    times.push_back(at.time());
    if (times.size() == 7) at.stop();
  });
  long attempts = 0;
  session.on_attempt([&](const Attempt&) { ++attempts; });
  Motion motion = session.dynamics(swing(0.02));
  CHECK_FALSE(motion.finish());
  CHECK(times.size() == 7);
  CHECK(times.back() == Approx(7e-3));
  CHECK(motion.finish());
  CHECK(times.size() == 20);
  CHECK(attempts == 20);
  Motion other = undisturbed.dynamics(swing(0.02));
  other.advance_to(7e-3);
  undisturbed.save();  // a stop leaves a point to go on from, which has its part in the rounding
  other.finish();
  CHECK(all_numbers(session) == all_numbers(undisturbed));
}

TEST_CASE("what a callback throws ends the run, and the motion stands at its last step") {
  Session session(swinging_arms().model);
  session.on_step([&](Session& at) {
    if (at.time() > 4.5e-3) throw std::runtime_error("enough");
  });
  Motion motion = session.dynamics(swing(0.02));
  CHECK(test::message_of<std::runtime_error>([&] { motion.finish(); }) == "enough");
  CHECK(session.time() == Approx(5e-3));
}

TEST_CASE("the session keeps the last state of a motion, and another one goes on from it") {
  Session session(swinging_arms().model);
  {
    Motion motion = session.dynamics(swing(0.1));
    motion.advance_to(0.05);
    CHECK(&session.state() == &motion.state());
  }
  CHECK(session.time() == Approx(0.05));
  Motion next = session.dynamics(swing(0.1));
  CHECK(next.begin() == Approx(0.05));
  CHECK(next.end() == Approx(0.15));
  CHECK(next.start().largest_displacement < 1e-9);
}

TEST_CASE("a motion moves no more when its session has done something else") {
  Session session(swinging_arms().model);
  Motion motion = session.dynamics(swing(0.1));
  motion.step();
  session.assemble();
  CHECK_THROWS_AS(motion.step(), std::logic_error);
  CHECK(motion.time() == Approx(1e-3));
  CHECK(session.time() == Approx(1e-3));
  Motion other = session.dynamics(swing(0.1));
  CHECK(other.step());
  CHECK(session.time() == Approx(2e-3));
}

TEST_CASE("a motion without duration or step is refused, and one that cannot start leaves the session as it was") {
  Session session(swinging_arms().model);
  CHECK_THROWS_AS(session.dynamics(DynamicsOptions()), InputError);
  Session stone(read_mechanism_text(R"yaml(
gravity: [0, 0, -10]
nodes: {stone: {position: [0, 0, 1]}}
elements: {stone: {type: point_mass, node: stone, mass: 1}}
)yaml",
                                    "stone.yaml")
                    .model);
  DynamicsOptions options = swing(0.1);
  options.equilibrium = true;
  const std::vector<double> before = all_numbers(stone);
  CHECK_THROWS_AS(stone.dynamics(options), ComputationError);
  CHECK(all_numbers(stone) == before);
}
