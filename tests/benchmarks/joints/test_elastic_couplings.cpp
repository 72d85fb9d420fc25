// Elastic couplings of joints, with backlash, against closed forms: gear, differential, rack and pinion.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using bielle::mechanism::Session;
using bielle::test::message_of;
using bielle::test::move;
using bielle::test::move_to;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_elastic_couplings {
namespace {

constexpr double J_1 = 0.3, J_2 = 0.5, ratio = -0.4, k = 2e3, w_1 = 9;
// The deformation e = c_2 - ratio c_1 has the reduced inertia J: its generalised force accelerates both shafts.
const double J = 1 / (ratio * ratio / J_1 + 1 / J_2);

/// Returns two shafts on the ground, the first of which turns. @param keys  of their gear
std::string shafts(const std::string& keys, double rate = w_1, const std::string& more = "") {
  return fmt::format(R"yaml(
nodes: {{a: {{}}, b: {{position: [0.5, 0, 0]}}}}
elements:
  a: {{type: rigid_body, node: a, mass: 1, inertia: [1, 1, {}]}}
  b: {{type: rigid_body, node: b, mass: 1, inertia: [1, 1, {}]}}
joints:
  first: {{type: hinge, nodes: [ground, a], axis: [0, 0, 1], start_rate: {}}}
  second: {{type: hinge, nodes: [ground, b], axis: [0, 0, 1]}}
  pair: {{type: gear, joints: [first, second], ratio: {}, {}}}
{})yaml",
                     J_1, J_2, rate, ratio, keys, more);
}

double read(const Session& session, const std::string& what, std::size_t place = 0) {
  return session.read("joints/" + what)[place];
}

struct Rates {
  double first, second;
};
/// Rates after a collision of the flanks with the coefficient of restitution r: edot becomes -r edot.
Rates after_collision(Rates before, double r) {
  const double impulse = (1 + r) * J * (before.second - ratio * before.first);
  return {before.first + ratio * impulse / J_1, before.second - impulse / J_2};
}

}  // namespace

TEST_CASE("two shafts vibrate against each other with the frequency of their elastic gear") {
  const double w = std::sqrt(k / J);
  double error = 1;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    double found = 0;
    move(shafts(fmt::format("stiffness: {}", k)), h, 0.2, [&](const Session& session) {
      const double e = -ratio * w_1 / w * std::sin(w * session.time());
      found = std::max(found, std::abs(read(session, "pair/deformation") - e));
      CHECK_THAT(session.balance(), WithinAbs(0, 1e-3 * 0.5 * J_1 * w_1 * w_1));
      // The values are the torques on each shaft, including that on the ground's side of the teeth.
      CHECK_THAT(read(session, "pair/force", 1), WithinRel(-k * read(session, "pair/deformation"), 1e-10));
      CHECK_THAT(read(session, "pair/force", 0), WithinRel(ratio * k * read(session, "pair/deformation"), 1e-10));
    });
    CHECK(found < error / 3);  // second order
    error = found;
  }
  CHECK(error < 2e-3 * std::abs(ratio) * w_1 / w);
}

TEST_CASE("the vibration of two shafts decays by the damping of their gear") {
  // J e'' + d e' + k e = 0 starts from e = 0 at the rate -ratio w_1.
  constexpr double d = 10;
  const double decay = d / (2 * J), w = std::sqrt(k / J - decay * decay), start = -ratio * w_1;
  double error = 1;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    double found = 0;
    move(shafts(fmt::format("stiffness: {}, damping: {}", k, d)), h, 0.2, [&](const Session& session) {
      const double t = session.time(), c = std::cos(w * t), s = std::sin(w * t), fade = std::exp(-decay * t);
      const double e = start / w * fade * s, rate = start * fade * (c - decay / w * s);
      found = std::max(found, std::abs(read(session, "pair/force", 1) + k * e + d * rate) / (k * start / w));
    });
    CHECK(found < error / 3);  // second order
    error = found;
  }
  CHECK(error < 2e-3);
}

TEST_CASE("at the place as drawn an elastic coupling without backlash has its stiffness once") {
  for (const std::string backlash : {"", ", backlash: 0"}) {
    Session session = session_of(shafts(fmt::format("stiffness: {}, damping: 1.5{}", k, backlash), 0));
    bielle::mechanism::ModesOptions options;
    const auto report = bielle::mechanism::compute_modes(session, options);
    double fastest = 0;
    for (const auto& mode : report.found.modes) fastest = std::max(fastest, std::abs(mode.s));
    CHECK_THAT(fastest, WithinRel(std::sqrt(k / J), 1e-9));
  }
}

TEST_CASE("a shaft passes through the backlash, strikes the other elastically, and leaves it") {
  const double b = 0.02, hits = 0.5 * b / std::abs(ratio * w_1), lasts = M_PI * std::sqrt(J / k);
  const Rates after = after_collision({w_1, 0}, 1);
  for (const double direction : {1.0, -1.0}) {
    double error = 1;
    for (const double h : {1e-3, 5e-4}) {
      bielle::mechanism::Session session =
          session_of(shafts(fmt::format("stiffness: {}, backlash: {}", k, b), direction * w_1));
      std::vector<bielle::mechanism::Event> events;
      session.on_event([&](const auto& event) { events.push_back(event); });
      session.dynamics(steps_of(hits + lasts + 2e-3, h)).finish();
      REQUIRE(events.size() == 2);
      CHECK_THAT(events[0].time, WithinRel(hits, 1e-8));
      CHECK_THAT(events[1].time, WithinRel(hits + lasts, 1e-3));
      CHECK_THAT(events[0].name, Contains(direction > 0 ? "forwards" : "backwards"));
      const double found = std::max(std::abs(read(session, "first/rate") - direction * after.first),
                                    std::abs(read(session, "second/rate") - direction * after.second));
      CHECK(found < error / 3);
      error = found;
      CHECK(read(session, "pair/force", 1) == 0);
      CHECK_THAT(session.balance(), WithinAbs(0, 2e-3 * 0.5 * J_1 * w_1 * w_1));
    }
    CHECK(error < 2e-2);
  }
}

TEST_CASE("a damped coupling dissipates what its shafts lose in a collision") {
  // The flanks separate when the force vanishes, before the deformation does.
  const double b = 0.02, d = 12, hits = 0.5 * b / std::abs(ratio * w_1), lasts = M_PI * std::sqrt(J / k) + 2e-3;
  const double w = std::sqrt(k / J), zeta = d / (2 * J * w), w_d = w * std::sqrt(1 - zeta * zeta);
  // p = (v/w_d) exp(-zeta w t) sin(w_d t); k p + d pdot = 0 where tan(w_d t) = -d w_d/(k - d zeta w).
  const double parts = (M_PI - std::atan2(d * w_d, k - d * zeta * w)) / w_d;
  const double r = -std::exp(-zeta * w * parts) *
                   (std::cos(w_d * parts) - zeta / std::sqrt(1 - zeta * zeta) * std::sin(w_d * parts));
  const Rates after = after_collision({w_1, 0}, r);
  const double lost = 0.5 * J_1 * (w_1 * w_1 - after.first * after.first) - 0.5 * J_2 * after.second * after.second;
  REQUIRE(r > 0.3);
  REQUIRE(r < 0.9);
  double error = 1;
  for (const double h : {4e-4, 2e-4})
    move_to(shafts(fmt::format("stiffness: {}, backlash: {}, damping: {}", k, b, d)), h, hits + lasts,
            [&](const Session& session) {
              const double found = std::abs(read(session, "second/rate") - after.second);
              CHECK(found < error / 1.8);
              error = found;
              CHECK_THAT(session.energy().dissipation, WithinRel(lost, 5e-3));
              CHECK_THAT(session.balance(), WithinAbs(0, 1e-3 * lost));
            });
  CHECK(error < 1e-2);
}

TEST_CASE("at rest a coupling gives its backlash and its deformation") {
  const double b = 0.03, T = 40;
  for (const double torque : {T, -T}) {
    const std::string held = fmt::format(R"yaml(
nodes: {{a: {{}}, b: {{position: [0.5, 0, 0]}}}}
elements:
  b: {{type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}}
joints:
  first: {{type: hinge, nodes: [ground, a], axis: [0, 0, 1], locked: true}}
  second: {{type: hinge, nodes: [ground, b], axis: [0, 0, 1], stiffness: 1e-3}}
  pair: {{type: gear, joints: [first, second], ratio: {}, stiffness: {}, backlash: {}}}
drives: {{load: {{joint: second, torque: {}}}}}
)yaml",
                                         ratio, k, b, torque);
    Session loaded = session_of(held);
    bielle::mechanism::StaticsOptions options;
    options.steps = 4;
    bielle::mechanism::compute_statics(loaded, options);
    const double e = std::copysign(0.5 * b + T / k, torque);
    CHECK_THAT(read(loaded, "second/coordinate"), WithinRel(e, 1e-5));  // the weak spring takes 1e-3 of 2000 N m/rad
    CHECK_THAT(read(loaded, "pair/force", 0), WithinRel(ratio * torque, 1e-5));
  }
}

TEST_CASE("a rack with play, and a differential with a soft input") {
  // A force of 3 N pushes the rack of 2 kg against a locked pinion: it moves by b/2 + F/k.
  const std::string rack = R"yaml(
nodes: {a: {}, r: {position: [0, -0.3, 0]}}
elements: {r: {type: point_mass, node: r, mass: 2}}
joints:
  pinion: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], locked: true}
  rack: {type: prismatic, nodes: [ground, r], axis: [1, 0, 0], damping: 60}
  pair: {type: rack_and_pinion, joints: [pinion, rack], radius: 0.3, stiffness: 1e3, backlash: 4e-3, damping: 20}
drives: {push: {joint: rack, force: 3}}
measures: {gap: pair.deformation, force: pair.force}
)yaml";
  move_to(rack, 2e-3, 3, [](const Session& session) {
    CHECK_THAT(read(session, "rack/coordinate"), WithinRel(2e-3 + 3e-3, 1e-6));
    CHECK_THAT(session.measure("gap"), WithinRel(5e-3, 1e-6));
    CHECK_THAT(session.measure("force"), WithinRel(3, 1e-6));
    CHECK_THAT(read(session, "pair/force", 0), WithinRel(0.3 * 3, 1e-6));  // on the pinion
    CHECK_THAT(read(session, "pair/force", 1), WithinRel(-3, 1e-6));
  });
  // Torques of 1 N m on both wheels twist the locked input's coupling: e = -ratio (left + right)/2, 2 N m/ratio.
  const std::string differential = R"yaml(
nodes: {i: {}, l: {}, r: {}}
elements:
  l: {type: rigid_body, node: l, mass: 1, inertia: [1, 1, 1]}
  r: {type: rigid_body, node: r, mass: 1, inertia: [1, 1, 1]}
joints:
  input: {type: hinge, nodes: [ground, i], axis: [0, 0, 1], locked: true}
  left: {type: hinge, nodes: [ground, l], axis: [0, 0, 1], stiffness: 1e-6}
  right: {type: hinge, nodes: [ground, r], axis: [0, 0, 1], stiffness: 1e-6}
  pair: {type: differential, joints: [input, left, right], ratio: 4, stiffness: 50}
drives: {l: {joint: left, torque: 1}, r: {joint: right, torque: 1}}
)yaml";
  Session session = session_of(differential);
  bielle::mechanism::compute_statics(session, {});
  CHECK_THAT(read(session, "pair/deformation"), WithinRel(-0.5 / 50, 1e-6));
  CHECK_THAT(read(session, "left/coordinate"), WithinRel(0.5 / 50 / 4, 1e-6));
  CHECK_THAT(read(session, "pair/force", 0), WithinRel(0.5, 1e-6));
  CHECK_THAT(read(session, "pair/force", 1), WithinRel(-1, 1e-6));
}

TEST_CASE("a saved motion within a contact of the flanks goes on to the last bit") {
  const std::string text = shafts(fmt::format("stiffness: {}, backlash: 0.02, damping: 1", k));
  Session session = session_of(text);
  auto motion = session.dynamics(steps_of(0.05, 1e-3));
  motion.advance_to(0.012);  // the flanks touch from 2.8 ms on for 29 ms
  REQUIRE(read(session, "pair/force", 1) != 0);
  const std::vector<double> saved = session.save();
  motion.finish();
  Session other = session_of(text);
  auto again = other.dynamics(steps_of(0.05, 1e-3), saved);
  again.finish();
  CHECK(read(other, "pair/deformation") == read(session, "pair/deformation"));
  CHECK(read(other, "second/rate") == read(session, "second/rate"));
}

TEST_CASE("backlash and damping without a stiffness are told to need one") {
  for (const std::string key : {"backlash: 0.01", "damping: 1", "backlash: 0"})
    CHECK_THAT(message_of<bielle::InputError>([&] { session_of(shafts(key)); }),
               Contains(key.substr(0, key.find(':'))) && Contains("give its `stiffness` as well"));
}

}  // namespace test_elastic_couplings
