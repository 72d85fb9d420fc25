// Coordinates that are locked for a time: the velocities after the inelastic impulse, the force of the lock, its
// release.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::model_of;
using bielle::test::steps_of;

namespace {

int redundant_in(const Session& session) {
  int count = 0;
  session.system().for_each_redundant(session.state(), [&](int) { ++count; });
  return count;
}

/// Returns rotors of 0.5 and 0.2 kg m^2 on one axle: the second turns in bearings on the ground or on the first; the
/// joint `clutch` is between the two in both cases. A torque of 3 N m turns the first.
std::string rotors(bool both_on_ground) {
  return R"yaml(
nodes:
  first: {position: [0, 0, 0], angular_velocity: [0, 0, 10]}
  second: {position: [0, 0, 0.2], angular_velocity: [0, 0, -4]}
elements:
  first: {type: rigid_body, node: first, mass: 3, inertia: [0.3, 0.3, 0.5]}
  second: {type: rigid_body, node: second, mass: 2, inertia: [0.1, 0.1, 0.2]}
joints:
  axle: {type: hinge, nodes: [ground, first], axis: [0, 0, 1]}
)yaml" + std::string(both_on_ground ? "  other: {type: hinge, nodes: [ground, second], axis: [0, 0, 1]}\n" : "") +
         R"yaml(  clutch: {type: hinge, nodes: [first, second], position: [0, 0, 0.1], axis: [0, 0, 1], locked: {from: 0.5, to: 0.7}}
loads: {motor: {node: first, moment: [0, 0, 3]}}
)yaml";
}

}  // namespace

TEST_CASE("two rotors are coupled for a time: momentum stays, the lost energy is booked") {
  const bool both_on_ground = GENERATE(false, true);
  const auto form = GENERATE(ConstraintForm::position, ConstraintForm::corrected, ConstraintForm::stabilised);
  // 0.7 is not a time of the grid of the second size.
  const double h = GENERATE(0.01, 0.033);
  CAPTURE(both_on_ground, static_cast<int>(form), h);
  constexpr double J1 = 0.5, J2 = 0.2, T = 3;
  Session session(model_of(rotors(both_on_ground)));
  CHECK(session.redundant().size() == (both_on_ground ? 1 : 0));
  Motion motion = session.dynamics(steps_of(0.99, h, form));
  const auto speed = [&](const char* node) { return session.node(node).Omega.z(); };
  while (motion.time() < 0.5 - 1e-12) motion.step();
  REQUIRE(motion.time() == 0.5);
  // The torque is constant, which is exact for the scheme.
  const double w1 = 10 + T / J1 * 0.5, w2 = -4;
  CHECK(speed("first") == Approx(w1).epsilon(1e-11));
  CHECK(speed("second") == Approx(w2).epsilon(1e-11));
  const double before = session.energy().dissipation;
  motion.step();
  const double together = (J1 * w1 + J2 * w2) / (J1 + J2), a = T / (J1 + J2), passed = motion.time() - 0.5;
  CHECK(speed("first") == Approx(together + a * passed).epsilon(1e-11));
  CHECK(speed("second") == Approx(together + a * passed).epsilon(1e-11));
  const double lost = J1 * J2 / (J1 + J2) * (w1 - w2) * (w1 - w2) / 2;
  CHECK(session.energy().dissipation - before == Approx(lost).epsilon(1e-10));
  // Powers grow linearly: the trapezoidal rule of the energy balance is exact.
  CHECK(session.balance() == Approx(0).margin(1e-10 * lost));
  // The lock turns the second rotor.
  CHECK(session.read("joints/clutch/lock_force")[0] == Approx(J2 * a).epsilon(1e-8));
  const double kept = session.read("joints/clutch/coordinate")[0];
  CHECK(kept == Approx(-14 * 0.5 - T / J1 * 0.125).epsilon(1e-10));
  CHECK(redundant_in(session) == (both_on_ground ? 5 : 0));
  while (motion.time() < 0.7 - 1e-12) motion.step();
  REQUIRE(motion.time() == Approx(0.7).epsilon(1e-15));
  CHECK(session.read("joints/clutch/coordinate")[0] == Approx(kept).epsilon(1e-12));
  const double until = together + a * 0.2;
  REQUIRE(motion.finish());
  CHECK(speed("first") == Approx(until + T / J1 * 0.29).epsilon(1e-11));
  CHECK(speed("second") == Approx(until).epsilon(1e-11));
  CHECK(session.read("joints/clutch/lock_force")[0] == 0);
  CHECK(session.energy().dissipation - before == Approx(lost).epsilon(1e-10));
  CHECK(session.balance() == Approx(0).margin(1e-10 * lost));
}

TEST_CASE("each coordinate of each pair is locked by itself") {
  struct Sample {
    const char *type, *coordinate;
    std::size_t index, count;
  };
  const Sample sample =
      GENERATE(Sample{"hinge", "angle", 0, 1}, Sample{"prismatic", "displacement", 0, 1},
               Sample{"cylindrical", "displacement", 0, 2}, Sample{"cylindrical", "angle", 1, 2},
               Sample{"spherical", "rx", 0, 3}, Sample{"spherical", "ry", 1, 3}, Sample{"spherical", "rz", 2, 3},
               Sample{"planar", "x", 0, 3}, Sample{"planar", "y", 1, 3}, Sample{"planar", "angle", 2, 3});
  const auto form = GENERATE(ConstraintForm::position, ConstraintForm::corrected, ConstraintForm::stabilised);
  CAPTURE(sample.type, sample.coordinate, static_cast<int>(form));
  const std::string text = std::string(R"yaml(
nodes: {body: {position: [0, 0, 0], velocity: [0.3, -0.5, 0.7], angular_velocity: [0.4, -0.9, 1.2]}}
elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [0.3, 0.3, 0.3]}}
joints: {pair: {type: )yaml") +
                           sample.type + ", nodes: [ground, body], position: [0, 0, 0], axis: [0, 0, 1], locked: {" +
                           sample.coordinate + ": {from: 0.25, to: 0.6}}}}\n";
  Session session(model_of(text));
  Motion motion = session.dynamics(steps_of(1, 0.01, form));
  const std::vector<double> start = session.read("joints/pair/rate");
  REQUIRE(start.size() == sample.count);
  while (motion.time() < 0.25 - 1e-12) motion.step();
  const double kept = session.read("joints/pair/coordinate")[sample.index];
  const bool turns = std::string(sample.type) == "spherical";
  if (!turns) CHECK(kept == Approx(0.25 * start[sample.index]).epsilon(1e-10));
  const double before = session.read("energy/kinetic")[0];
  motion.step();
  while (motion.time() < 0.6 - 1e-12) {
    motion.step();
    CHECK(session.read("joints/pair/coordinate")[sample.index] == Approx(kept).epsilon(1e-11));
  }
  const double dissipated = session.energy().dissipation;
  if (turns) {
    // The impulse is the least change of velocity that stops the coordinate: some energy is lost, not all of it, and
    // the loss is booked. The energy balance is closed up to the scheme's error of order 2 in a turn of 1.5 rad/s.
    CHECK(dissipated > 0.01 * before);
    CHECK(dissipated < 0.99 * before);
    CHECK(session.balance() == Approx(0).margin(1e-5 * before));
  } else {
    const double load =
        session.system().event_functions().empty() && std::string(sample.coordinate) == "angle" ? 0.3 : 2;
    CHECK(dissipated == Approx(load * start[sample.index] * start[sample.index] / 2).epsilon(1e-10));
    const std::vector<double> rate = session.read("joints/pair/rate");
    for (std::size_t k = 0; k < sample.count; ++k)
      CHECK(rate[k] == Approx(k == sample.index ? 0 : start[k]).margin(1e-11));
  }
  REQUIRE(motion.finish());
  for (const double force : session.read("joints/pair/lock_force")) CHECK(force == 0);
}

TEST_CASE("a lock opens at its force") {
  // A force of 50 N/s t on 2 kg: 20 N at 0.4 s; from there q = 50 ((t^3 - s^3)/6 - s^2 (t - s)/2)/m, s = 0.4.
  const double h = GENERATE(0.01, 0.0317, 0.1);
  const double sign = GENERATE(1.0, -1.0);
  const std::string text = std::string(R"yaml(
nodes: {body: {position: [0, 0, 0]}}
elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [0.3, 0.3, 0.3]}}
joints: {path: {type: prismatic, nodes: [ground, body], axis: [1, 0, 0], locked: {release: 20}}}
loads: {pull: {node: body, force: [")yaml") +
                           (sign > 0 ? "" : "-") + "50*t\", 0, 0]}}\n";
  Session session(model_of(text));
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  Motion motion = session.dynamics(steps_of(1, h));
  REQUIRE(motion.finish());
  REQUIRE(events.size() == 1);
  CHECK(events[0].name == "joint 'path': displacement is released");
  // The force is linear in t, and the lock balances it.
  CHECK(events[0].time == Approx(0.4).margin(1e-10 * h + 1e-13).epsilon(0));
  CHECK(session.read("joints/path/lock_force")[0] == 0);
  // Linear accelerations: the velocity of a step is exact, its position off by h^3 j/12 or less, adding up to
  // h^2 j (t - s)/12.
  const double s = 0.4, j = sign * 25;
  CHECK(session.read("joints/path/rate")[0] == Approx(j * (1 - s * s) / 2).epsilon(1e-9));
  CHECK(session.read("joints/path/coordinate")[0] ==
        Approx(j * ((1 - s * s * s) / 6 - s * s * (1 - s) / 2)).margin(h * h * 25 * 0.6 / 6));
}

TEST_CASE("a lock that is loaded beyond its release at once opens at once") {
  // 30 N act from 0.2 s on, or from the start: more than the 20 N that the lock holds.
  const double from = GENERATE(0.2, -1.0);
  const std::string text = R"yaml(
nodes: {body: {position: [0, 0, 0]}}
elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [0.3, 0.3, 0.3]}}
joints: {path: {type: prismatic, nodes: [ground, body], axis: [1, 0, 0], locked: {release: 20}}}
loads: {pull: {node: body, force: ["if(t < )yaml" +
                           std::to_string(from) +
                           R"yaml(, 0, 30)", 0, 0]}}
)yaml";
  Session session(model_of(text));
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  Motion motion = session.dynamics(steps_of(0.5, 0.01));
  REQUIRE(motion.finish());
  const double moved = 0.5 - std::max(from, 0.0);
  CHECK(session.read("joints/path/rate")[0] == Approx(15 * moved).epsilon(1e-9));
  CHECK(session.read("joints/path/coordinate")[0] == Approx(7.5 * moved * moved).epsilon(1e-9));
  REQUIRE(events.size() == 1);
  CHECK(events[0].time == Approx(std::max(from, 0.0)).margin(1e-12));
}

TEST_CASE("a lock holds in statics and while a mechanism is put together") {
  // A spring would lower the body by 3 g / 600; the lock holds the weight.
  const std::string text = R"yaml(
gravity: [0, 0, -10]
nodes: {body: {position: [0, 0, -1]}}
elements: {body: {type: rigid_body, node: body, mass: 3, inertia: [0.3, 0.3, 0.3]}}
joints: {path: {type: prismatic, nodes: [ground, body], axis: [0, 0, 1], stiffness: 600LOCKED}}
)yaml";
  const auto with = [&](const std::string& locked) {
    std::string whole = text;
    whole.replace(whole.find("LOCKED"), 6, locked);
    return whole;
  };
  Session free(model_of(with("")));
  compute_statics(free);
  CHECK(free.read("joints/path/coordinate")[0] == Approx(-0.05).epsilon(1e-9));
  CHECK(free.read("joints/path/spring_force")[0] == Approx(30).epsilon(1e-9));
  Session locked(model_of(with(", locked: {from: 0, to: 0.3}")));
  locked.assemble();
  CHECK(locked.read("joints/path/coordinate")[0] == 0);
  compute_statics(locked);
  CHECK(locked.read("joints/path/coordinate")[0] == Approx(0).margin(1e-15));
  CHECK(locked.read("joints/path/lock_force")[0] == Approx(30).epsilon(1e-9));
  // The lock opens at 0.3: the body oscillates about the equilibrium.
  Motion motion = locked.dynamics(steps_of(0.6, 1e-3));
  while (motion.time() < 0.3) motion.step();
  CHECK(locked.read("joints/path/coordinate")[0] == Approx(0).margin(1e-15));
  REQUIRE(motion.finish());
  const double omega = std::sqrt(200.0);  // (omega h)^2/12 of a phase of 4.2 rad is 7e-5
  CHECK(locked.read("joints/path/coordinate")[0] == Approx(-0.05 * (1 - std::cos(omega * 0.3))).margin(2e-5));
}

TEST_CASE("a four-bar linkage is stopped by the lock of a hinge, held, and let go") {
  // A parallelogram of bars of 1 m, 1, 1 and 2 kg, upright: the coupler does not turn. With the crank's angle a (about
  // y, from upright) the weight's potential is G cos a, G = (m_1/2 + m_3/2 + m_2) g, and J = J_1 + J_3 + m_2 about the
  // bearings. Three constraints are redundant: the motion of hinges with parallel axes is planar.
  const auto form = GENERATE(ConstraintForm::position, ConstraintForm::corrected, ConstraintForm::stabilised);
  const bool second_lock = GENERATE(false, true);  // lock of the rocker: it repeats the first one
  CAPTURE(static_cast<int>(form), second_lock);
  const std::string text = R"yaml(
gravity: [0, 0, -10]
nodes:
  crank: {position: [0, 0, 0.5]}
  coupler: {position: [1, 0, 1], velocity: [0.5, 0, 0]}
  rocker: {position: [2, 0, 0.5]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.0833333333333333, 0.0833333333333333, 0.01]}
  coupler: {type: rigid_body, node: coupler, mass: 2, inertia: [0.01, 0.2, 0.2]}
  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [0.0833333333333333, 0.0833333333333333, 0.01]}
joints:
  a: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 1, 0], locked: {from: 0.25, to: 0.4}}
  b: {type: hinge, nodes: [crank, coupler], position: [0, 0, 1], axis: [0, 1, 0]}
  c: {type: hinge, nodes: [coupler, rocker], position: [2, 0, 1], axis: [0, 1, 0]}
  d: {type: hinge, nodes: [ground, rocker], position: [2, 0, 0], axis: [0, 1, 0]LOCKED}
)yaml";
  std::string drawn = text;
  drawn.replace(drawn.find("LOCKED"), 6, second_lock ? ", locked: {from: 0.3, to: 0.4}" : "");
  constexpr double G = (0.5 + 0.5 + 2) * 10, J = 2.0 / 3 + 2;
  Session session(model_of(drawn));
  CHECK(redundant_in(session) == 3);
  Motion motion = session.dynamics(steps_of(0.7, 1e-3, form));
  const auto angle = [&] { return session.read("joints/a/coordinate")[0]; };
  const auto rate = [&] { return session.read("joints/a/rate")[0]; };
  const double energy = J * rate() * rate() / 2;  // the weight's potential is G (cos a - 1)
  CHECK(rate() > 0.1);
  while (motion.time() < 0.25) motion.step();
  const double at = angle(), stored = energy + G * (1 - std::cos(at));
  // (Errors are of order 2: w^2 h^2 = 1e-5 with w^2 = G/J.)
  CHECK(J * rate() * rate() / 2 == Approx(stored).epsilon(1e-5));
  const double kinetic = session.energy().kinetic;
  while (motion.time() < 0.4) {
    motion.step();
    CHECK(redundant_in(session) == (second_lock && motion.time() > 0.3 + 1e-9 ? 4 : 3));
    CHECK(angle() == Approx(at).epsilon(1e-10));
    CHECK(std::abs(rate()) < 1e-9);
    // The forces of the locks, together if there are two: the single moment that they transmit.
    const double other = second_lock ? session.read("joints/d/lock_force")[0] : 0;
    CHECK(session.read("joints/a/lock_force")[0] + other == Approx(-G * std::sin(at)).epsilon(1e-6));
  }
  CHECK(session.energy().dissipation == Approx(kinetic).epsilon(1e-9));
  const double gone = session.time();
  REQUIRE(gone == 0.4);
  REQUIRE(motion.finish());
  CHECK(redundant_in(session) == 3);
  CHECK(J * rate() * rate() / 2 == Approx(G * (std::cos(at) - std::cos(angle()))).epsilon(1e-5));
  CHECK(std::abs(session.balance()) < 1e-5 * stored);
}

TEST_CASE("a lock that steps cannot end on closes with the next one") {
  // There are more kinks than steps: a torque too small to change the speeds jumps at each of them.
  std::string text = rotors(false);
  std::string kinks = "0*t";
  for (int k = 1; k <= 12; ++k) kinks += " + 1e-9*pulse(t, " + std::to_string(0.05 * k + 0.011) + ", 2)";
  text.replace(text.find("[0, 0, 3]"), 9, "[0, 0, \"" + kinks + "\"]");
  text.replace(text.find("from: 0.5"), 9, "from: 0.45");
  Session session(model_of(text));
  Motion motion = session.dynamics(steps_of(1, 0.1));
  REQUIRE(motion.finish());
  CHECK(motion.log().steps == 10);
  CHECK(session.node("first").Omega.z() == Approx(6).epsilon(1e-6));
  CHECK(session.node("second").Omega.z() == Approx(6).epsilon(1e-6));
  // The clutch closes at 0.5 s and opens at 0.7 s; its torque is zero at the end.
  CHECK(session.read("joints/clutch/coordinate")[0] == Approx(-14 * 0.5).epsilon(1e-6));
  CHECK(session.read("joints/clutch/lock_force")[0] == 0);
}

TEST_CASE("a session goes back and on across locks to the last bit") {
  const auto end_of = [](Session& session, Motion& motion) {
    REQUIRE(motion.finish());
    std::vector<double> numbers;
    for (const char* name : {"joints/clutch/coordinate", "joints/clutch/rate", "nodes/first/velocity",
                             "nodes/first/rotation", "nodes/second/rotation", "energy/dissipated", "energy/balance"})
      for (const double number : session.read(name)) numbers.push_back(number);
    return numbers;
  };
  for (const double when : {0.3, 0.5, 0.6, 0.7}) {  // at the kinks themselves the next value is pending
    INFO(when);
    Session session(model_of(rotors(true)));
    Motion motion = session.dynamics(steps_of(0.99, 0.01));
    REQUIRE(motion.advance_to(when));
    const std::vector<double> saved = session.save();
    const std::vector<double> wanted = end_of(session, motion);
    session.restore(saved);
    CHECK(end_of(session, motion) == wanted);
    Session other(model_of(rotors(true)));
    Motion on = other.dynamics(steps_of(0.99, 0.01), saved);
    CHECK(end_of(other, on) == wanted);
  }
}

TEST_CASE("a coordinate is locked by a number or formula of parameters that is not zero") {
  const auto angle_after = [](const std::string& locked) {
    Session session(model_of(R"yaml(
parameters: {deployed: 1}
gravity: [0, 0, -9.81]
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {hinge: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0], locked: )yaml" +
                             locked + "}}\n"));
    REQUIRE(session.dynamics(steps_of(0.2, 0.01)).finish());
    return session.node("arm").x[2];
  };
  CHECK(std::abs(angle_after("deployed")) < 1e-10);
  CHECK(std::abs(angle_after("true")) < 1e-10);
  CHECK(angle_after("1 - deployed") < -0.1);
  CHECK(angle_after("false") < -0.1);
}
