// Clutches, brakes, torque limiters, one-way clutches and ratchets against closed forms.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_clutches {
namespace {

constexpr double J_1 = 0.3, J_2 = 0.5, w_0 = 40;

/// Returns two flywheels on an axis. @param clutch  keys of the joint between them
std::string flywheels(const std::string& clutch, const std::string& more = "") {
  return fmt::format(R"yaml(
nodes: {{a: {{}}, b: {{}}}}
elements:
  a: {{type: rigid_body, node: a, mass: 1, inertia: [1, 1, {}]}}
  b: {{type: rigid_body, node: b, mass: 1, inertia: [1, 1, {}]}}
joints:
  shaft: {{type: hinge, nodes: [ground, a], axis: [0, 0, 1], start_rate: {}}}
  between: {{type: hinge, nodes: [a, b], axis: [0, 0, 1], start_rate: {}, {}}}
{})yaml",
                     J_1, J_2, w_0, -w_0, clutch, more);
}

/// Returns a flywheel of 2 kg m^2 on the ground.
std::string wheel(const std::string& keys, double rate, const std::string& torque) {
  return fmt::format(R"yaml(
nodes: {{w: {{}}}}
elements: {{w: {{type: rigid_body, node: w, mass: 1, inertia: [1, 1, 2]}}}}
joints: {{axle: {{type: hinge, nodes: [ground, w], axis: [0, 0, 1], start_rate: {}, {}}}}}
drives: {{load: {{joint: axle, torque: "{}"}}}}
)yaml",
                     rate, keys, torque);
}

double read(const Session& session, const std::string& what) { return session.read("joints/" + what)[0]; }

/// Returns the root of a function that changes its sign between two places.
template <class Function>
double root(const Function& f, double low, double high) {
  const bool rises = f(high) > 0;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<bielle::mechanism::Event> events_of(const std::string& text, double h, double end,
                                                const bielle::test::Look& look) {
  const auto file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<bielle::mechanism::Event> events;
  session.on_event([&](const bielle::mechanism::Event& event) { events.push_back(event); });
  bielle::mechanism::DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  session.dynamics(options).finish();
  look(session);
  return events;
}

}  // namespace

TEST_CASE("a clutch brings two flywheels together in the time of its capacity, and takes the energy of their slip") {
  const double C = 60, reduced = J_1 * J_2 / (J_1 + J_2), slips = reduced * w_0 / C;
  const double common = J_1 * w_0 / (J_1 + J_2), lost = 0.5 * reduced * w_0 * w_0;
  for (const std::string& capacity :
       {std::string("capacity: 60"), std::string("normal_force: 1000, coefficient: 0.25, radius: 0.08, surfaces: 3")}) {
    const auto events = events_of(flywheels("clutch: {" + capacity + "}"), 7e-3, 0.5, [&](const Session& session) {
      CHECK_THAT(read(session, "shaft/rate"), WithinRel(common, 1e-10));
      CHECK_THAT(read(session, "between/rate"), WithinAbs(0, 1e-11));
      CHECK_THAT(read(session, "between/coordinate"), WithinRel(-0.5 * w_0 * slips, 1e-9));
      CHECK_THAT(session.energy().dissipation, WithinRel(lost, 1e-9));
      CHECK_THAT(session.balance(), WithinAbs(0, 1e-8 * lost));
      CHECK(read(session, "between/clutch_sticks") == 1);
      CHECK_THAT(read(session, "between/clutch_force"), WithinAbs(0, 1e-9));
    });
    REQUIRE(events.size() == 1);
    CHECK_THAT(events[0].time, WithinRel(slips, 1e-9));
  }
}

TEST_CASE("a clutch that is pressed little by little engages at the time of its ramp, whatever the grid") {
  // The torque of 500 t N m gives w_0 = 500 t^2/2 (1/J_1 + 1/J_2).
  const double engages = std::sqrt(2 * w_0 / (500 * (1 / J_1 + 1 / J_2)));
  std::vector<double> errors;
  for (const double h : {8e-3, 4e-3, 2e-3, 1.9e-3}) {
    const auto events = events_of(flywheels("clutch: {capacity: 500*t}"), h, 0.4, [](const Session& session) {
      CHECK_THAT(read(session, "shaft/rate"), WithinRel(J_1 * w_0 / (J_1 + J_2), 1e-9));  // momentum
    });
    REQUIRE(events.size() == 1);
    errors.push_back(std::abs(events[0].time - engages));
  }
  CHECK(errors[2] < 1e-4 * engages);
  CHECK(errors[3] < 1e-4 * engages);
}

TEST_CASE("a brake stops a wheel after its time and angle, holds it, and slips beyond its torque at rest") {
  // 2 kg m^2 at 30 rad/s, 12 N m.
  const std::string brake = "clutch: {capacity: 12, static_ratio: 1.5}";
  const auto events = events_of(wheel(brake, 30, "0"), 0.013, 6, [](const Session& session) {
    CHECK_THAT(read(session, "axle/coordinate"), WithinRel(0.5 * 30 * 5, 1e-10));
    CHECK_THAT(read(session, "axle/rate"), WithinAbs(0, 1e-12));
  });
  REQUIRE(events.size() == 1);
  CHECK_THAT(events[0].time, WithinRel(5, 1e-10));
  move_to(wheel(brake, 0, "17.9"), 0.01, 1, [](const Session& session) {
    CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0, 1e-14));
    CHECK_THAT(read(session, "axle/clutch_force"), WithinRel(-17.9, 1e-12));
  });
  move_to(wheel(brake, 0, "18.1"), 0.01, 1, [](const Session& session) {
    CHECK_THAT(read(session, "axle/rate"), WithinRel((18.1 - 12) / 2, 1e-9));
    CHECK_THAT(read(session, "axle/clutch_force"), WithinRel(-12, 1e-12));
  });
}

TEST_CASE("an open clutch lets its flywheels pass each other, also at the same rate") {
  // The clutch is open until 0.2 s. The first wheel is driven past the second, whose rate it has at 0 and at 0.1 s: w_1
  // = 40 - 200 t (t - 0.1).
  const std::string text =
      wheel("clutch: {capacity: \"if(t > 0.2, 30, 0)\"}", 0, "2*(-200)*(2*t - 0.1)*if(t > 0.2, 0, 1)");
  for (const double h : {0.01, 0.007})
    move_to(text, h, 0.6, [h](const Session& session) {
      // The relative rate is -200 t (t - 0.1) = -4 rad/s at 0.2 s; then 15 rad/s^2 reduce it to zero within 4/15 s.
      const double before = -200 * (0.008 / 3 - 0.1 * 0.04 / 2), after = -0.5 * 4 * 4 / 15;
      CHECK_THAT(read(session, "axle/coordinate"),
                 WithinAbs(before + after, 400 * 0.2 * h * h / 10));  // jerk 400 rad/s^3
      CHECK_THAT(read(session, "axle/rate"), WithinAbs(0, 1e-11));
      CHECK(read(session, "axle/clutch_sticks") == 1);
    });
  // The wheel is at rest without a load when the clutch closes.
  const auto events =
      events_of(wheel("clutch: {capacity: \"if(t > 0.2, 30, 0)\"}", 0, "0"), 0.01, 0.4, [](const Session& session) {
        CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0, 1e-12));
        CHECK(read(session, "axle/clutch_sticks") == 1);
      });
  CHECK(events.size() == 1);
}

TEST_CASE("a brake whose force follows the rate slows the wheel down exponentially") {
  // With the capacity 4 |w|, 2 w' = -4 w.
  const double h = 2e-3;
  move_to(wheel("clutch: {capacity: 4*abs(axle.angle.rate)}", 30, "0"), h, 1, [&](const Session& session) {
    CHECK_THAT(read(session, "axle/rate"), WithinRel(30 * std::exp(-2.0), 4 * h * h));
  });
}

TEST_CASE("a torque limiter slips by the angle of an overload, and holds again") {
  // The motor turns uniformly; the wheel behind the limiter carries the load 32 t (2 - t) <= 32 N m. It slips from 1.25
  // * 24 N m on with 24 N m.
  const double C = 24, J = 2;
  const auto load = [](double t) { return 32 * t * (2 - t); };
  const double begins = root([&](double t) { return load(t) - 1.25 * C; }, 0, 1);
  const auto lag = [&](double t) {  // J times the rate of slip: integral of load - C
    const auto integral = [](double s) { return 32 * (s * s - s * s * s / 3); };
    return integral(t) - integral(begins) - C * (t - begins);
  };
  const double holds = root(lag, 1.5, 2.2);
  double angle = 0;  // Simpson's rule is exact for a cubic
  angle = (holds - begins) / 6 * (lag(begins) + 4 * lag(0.5 * (begins + holds)) + lag(holds)) / J;
  const std::string text = R"yaml(
nodes: {m: {}, w: {}}
elements: {w: {type: rigid_body, node: w, mass: 1, inertia: [1, 1, 2]}}
joints:
  motor: {type: hinge, nodes: [ground, m], axis: [0, 0, 1]}
  limiter: {type: hinge, nodes: [m, w], axis: [0, 0, 1], clutch: {capacity: 24, static_ratio: 1.25}}
  axle: {type: hinge, nodes: [ground, w], axis: [0, 0, 1], start_rate: 10}
drives: {motor: {joint: motor, angle: 10*t}, load: {joint: axle, torque: -32*t*(2 - t)}}
)yaml";
  std::vector<double> errors;
  for (const double h : {8e-3, 4e-3, 2e-3}) {
    const auto events = events_of(text, h, 2.2, [&](const Session& session) {
      errors.push_back(std::abs(read(session, "limiter/coordinate") + angle));
      CHECK_THAT(read(session, "axle/rate"), WithinRel(10, 1e-10));
    });
    REQUIRE(events.size() == 2);
    CHECK_THAT(events[0].time, WithinAbs(begins, 2 * h * h));
    CHECK_THAT(events[1].time, WithinAbs(holds, 2 * h * h));
  }
  CHECK(errors[2] < 1e-5 * angle);
}

TEST_CASE("a sprag clutch under an alternating torque advances as the piecewise solution, to the second order") {
  // J v' = T (sin(W t) - b): the clutch opens at sin = b and holds again at v = 0, once in each period.
  const double J = 2, T = 9, W = 5, b = 0.3, opens = std::asin(b) / W;
  const auto rate = [&](double t) { return T / J * ((std::cos(W * opens) - std::cos(W * t)) / W - b * (t - opens)); };
  const double holds = root(rate, M_PI / W, 2 * M_PI / W + opens);
  const auto travel = [&](double t) {  // from `opens` on
    const double s = std::min(t, holds);
    return T / J *
           (std::cos(W * opens) * (s - opens) / W - (std::sin(W * s) - std::sin(W * opens)) / (W * W) -
            0.5 * b * (s - opens) * (s - opens));
  };
  const auto exact = [&](double t) {
    const double cycles = std::floor(t * W / (2 * M_PI)), phase = t - cycles * 2 * M_PI / W;
    return cycles * travel(holds) + (phase > opens ? travel(phase) : 0);
  };
  for (const double sense : {1.0, -1.0}) {
    const std::string text = wheel(fmt::format("one_way: {{direction: {}}}", sense > 0 ? "forwards" : "backwards"), 0,
                                   fmt::format("{}*(sin(5*t) - 0.3)", sense * T));
    const auto error = [&](double h) {
      double largest = 0;
      move(text, h, 3.7, [&](const Session& session) {
        largest = std::max(largest, std::abs(sense * read(session, "axle/coordinate") - exact(session.time())));
        if (read(session, "axle/one_way_holds") == 1) CHECK(sense * read(session, "axle/one_way_force") >= -1e-9);
        CHECK(sense * read(session, "axle/rate") >= -1e-9);
      });
      return largest;
    };
    const double coarse = error(0.02), fine = error(0.01), between = error(0.0123);
    CHECK_THAT(std::log2(coarse / fine), WithinAbs(2, 0.3));
    CHECK(between < coarse);
    CHECK(fine < 3 * 0.05 * 0.05 * travel(holds));  // (W h)^2 in each of three periods
  }
}

TEST_CASE("a rocker moves a winch on by a freewheel, and a pawl keeps it") {
  // Three rigid constraints act on two angles while both are at rest: the clutch that the motion needs holds.
  const std::string freewheel = "  freewheel: {type: hinge, nodes: [rocker, winch], axis: [0, 0, 1], one_way: {}}\n",
                    pawl = "  pawl: {type: hinge, nodes: [ground, winch], axis: [0, 0, 1], one_way: {}}\n";
  const bool pawl_first = GENERATE(false, true);
  const double h = GENERATE(0.01, 0.0137);
  CAPTURE(pawl_first, h);
  const std::string text = R"yaml(
nodes: {rocker: {}, winch: {}}
elements:
  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [1, 1, 0.1]}
  winch: {type: rigid_body, node: winch, mass: 1, inertia: [1, 1, 0.5]}
joints:
  crank: {type: hinge, nodes: [ground, rocker], axis: [0, 0, 1]}
)yaml" + (pawl_first ? pawl + freewheel : freewheel + pawl) +
                           R"yaml(drives:
  swing: {joint: crank, angle: "0.5*(1 - cos(2*t))"}
  load: {joint: pawl, torque: "-1"}
)yaml";
  double largest = 0;
  move(text, h, 6, [&](const Session& session) {
    const double t = session.time(), phase = std::fmod(t, M_PI);
    const bool forwards = phase < M_PI / 2;
    const double exact = std::floor(t / M_PI) + (forwards ? 0.5 * (1 - std::cos(2 * phase)) : 1);
    largest = std::max(largest, std::abs(read(session, "pawl/coordinate") - exact));
    if (std::min(phase, std::abs(phase - M_PI / 2)) < 2 * h) return;
    // The winch is accelerated against its load, or rests on its pawl.
    CHECK_THAT(read(session, "freewheel/one_way_force"), WithinAbs(forwards ? 1 + std::cos(2 * phase) : 0, 5 * h));
    CHECK_THAT(read(session, "pawl/one_way_force"), WithinAbs(forwards ? 0 : 1, 1e-9));
  });
  CHECK(largest < h * h);
}

TEST_CASE("a rigid one-way clutch yields to a drive forwards, and contradicts it backwards") {
  const auto driven = [](const char* angle) {
    std::string text = wheel("one_way: {}", 0, "0");
    const std::string start = "start_rate: 0, ", drive = "torque: \"0\"";
    text.replace(text.find(start), start.size(), "");
    return text.replace(text.find(drive), drive.size(), std::string("angle: \"") + angle + "\"");
  };
  move_to(driven("if(t < 0.5, 0, (t - 0.5)^2)"), 0.01, 1, [](const Session& session) {
    CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0.25, 1e-9));
    CHECK_THAT(read(session, "axle/drive_force"), WithinAbs(4, 1e-6));
    CHECK(read(session, "axle/one_way_holds") == 0);
  });
  CHECK_THROWS_WITH(move_to(driven("-t^2"), 0.01, 1, [](const Session&) {}),
                    Contains("held one way of joint 'axle' cannot hold: a drive"));
  CHECK_THROWS_WITH(move_to(driven("t^2*(1 - t)"), 0.01, 1, [](const Session&) {}), Contains("cannot hold"));
}

TEST_CASE("three one-way clutches hold two wheels both ways, whichever of them push") {
  // The first wheel may turn forwards, the second one backwards, and forwards relative to the first one: neither turns.
  // The signs of the torques, and of their sum, determine which two clutches have a force.
  const std::string text = R"yaml(
nodes: {a: {}, b: {}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [5, 5, 1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [5, 5, 1]}
joints:
  first: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], one_way: {}}
  second: {type: hinge, nodes: [ground, b], axis: [0, 0, 1], one_way: {direction: backwards}}
  between: {type: hinge, nodes: [a, b], axis: [0, 0, 1], one_way: {}}
drives:
  of_first: {joint: first, torque: 6*sin(5.6*t + 0.3)}
  of_second: {joint: second, torque: 9*sin(3*t + 2.5)}
)yaml";
  double last = 0;
  move(text, 0.01, 2, [&](const Session& session) {
    last = session.time();
    CHECK_THAT(read(session, "first/coordinate"), WithinAbs(0, 1e-9));
    CHECK_THAT(read(session, "second/coordinate"), WithinAbs(0, 1e-9));
    CHECK(read(session, "first/one_way_force") >= -1e-6);
    CHECK(read(session, "second/one_way_force") <= 1e-6);
    CHECK(read(session, "between/one_way_force") >= -1e-6);
  });
  CHECK(last == Approx(2));
}

TEST_CASE("an elastic one-way clutch engages where it is activated") {
  // 4 N m turn 2 kg m^2 backwards for 0.5 s, to -0.25 rad at -1 rad/s; then the spring turns it back by k p^2 = J w^2 +
  // 2 T p.
  const std::string text = R"yaml(
nodes: {w: {}}
elements: {w: {type: rigid_body, node: w, mass: 1, inertia: [1, 1, 2]}}
joints:
  axle: {type: hinge, nodes: [ground, w], axis: [0, 0, 1]}
  dog: {type: hinge, nodes: [ground, w], axis: [0, 0, 1], one_way: {stiffness: 1e3}, active: false}
loads: {torque: {node: w, moment: [0, 0, -4]}}
events: {on: {when: t, crosses: 0.5, do: [{activate: dog}]}}
)yaml";
  double least = 0;
  move(text, 0.0005, 0.6, [&](const Session& session) { least = std::min(least, read(session, "axle/coordinate")); });
  const double k = 1e3, J = 2, T = 4, p = (T + std::sqrt(T * T + k * J)) / k;
  CHECK_THAT(least, WithinAbs(-0.25 - p, 1e-4));
}

TEST_CASE("a one-way clutch that is released while it holds engages elsewhere when it is activated") {
  // 4 N m turn 2 kg m^2 backwards for 0.5 s, to -0.25 rad at -1 rad/s. The clutch holds there, a ratchet at its next
  // tooth.
  for (const auto& [keys, place] : {std::pair("", -0.25), std::pair("pitch: 0.1", -0.3)}) {
    const std::string text = fmt::format(R"yaml(
nodes: {{w: {{}}}}
elements: {{w: {{type: rigid_body, node: w, mass: 1, inertia: [1, 1, 2]}}}}
joints:
  axle: {{type: hinge, nodes: [ground, w], axis: [0, 0, 1]}}
  dog: {{type: hinge, nodes: [ground, w], axis: [0, 0, 1], one_way: {{{}}}}}
loads: {{torque: {{node: w, moment: [0, 0, -4]}}}}
events:
  away: {{when: t, crosses: 1, do: [{{release: dog}}]}}
  back: {{when: t, crosses: 1.5, do: [{{activate: dog}}]}}
)yaml",
                                         keys);
    move(text, 0.01, 2, [&, at = place](const Session& session) {
      if (session.time() < 1) CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0, 1e-12));
      if (session.time() > 1.6) CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(at, 1e-6));
    });
  }
}

TEST_CASE("a load that bounces on an elastic pawl comes to rest on it, also if it is back within a step") {
  for (const bool forwards : {true, false})
    for (const double step : {1e-3, 4e-3})
      for (const double start : {0.01, 0.06}) {
        CAPTURE(forwards, step, start);
        const double sense = forwards ? 1 : -1, tooth = start < 0.05 ? 0 : 0.05;
        const std::string text = fmt::format(R"yaml(
nodes: {{a: {{}}}}
elements: {{a: {{type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}}}
joints:
  rail: {{type: prismatic, nodes: [ground, a], axis: [0, 0.6, 0.8], start: {},
         one_way: {{direction: {}, pitch: 0.05, stiffness: 1e5, damping: 50}}}}
drives: {{load: {{joint: rail, force: {}}}}}
)yaml",
                                             sense * start, forwards ? "forwards" : "backwards", -10 * sense);
        move_to(text, step, 1, [&](const Session& session) {
          CHECK(read(session, "rail/coordinate") == Approx(sense * (tooth - 1e-4)).margin(1e-7));  // F/k
          CHECK(read(session, "rail/one_way_force") == Approx(10 * sense).epsilon(1e-3));
        });
      }
}

TEST_CASE("a ratchet holds at the last tooth that it has passed, and lets go forwards") {
  // Started forwards at 3 rad/s against 4 N m, the wheel turns to 2.25 rad and back to the last of the teeth at 0.4
  // rad, 2 rad. The torque changes its sign at 8 s and moves it on.
  for (const double h : {0.01, 0.0137}) {
    const auto events = events_of(wheel("one_way: {pitch: 0.4}", 3, "-4 + 0.5*t"), h, 9, [](const Session& session) {
      // 2 v' = -4 + t/2 from rest at 8 s: v = (t - 8)^2/8, 2.4 + (t - 8)^3/24.
      CHECK_THAT(read(session, "axle/rate"), WithinRel(1.0 / 8, 1e-4));
      CHECK_THAT(read(session, "axle/coordinate"), WithinRel(2.4 + 1.0 / 24, 1e-5));
      CHECK(read(session, "axle/one_way_holds") == 0);
    });
    REQUIRE(events.size() == 2);
    CHECK_THAT(events[1].time, WithinRel(8, 1e-6));
  }
  // With a constant torque it turns to 2.25 rad, and is back at 2 rad after 3/2 + sqrt(0.25) s with 1 rad/s: 1 J is
  // lost.
  const auto events = events_of(wheel("one_way: {pitch: 0.4}", 3, "-4"), 0.01, 4, [](const Session& session) {
    CHECK_THAT(read(session, "axle/coordinate"), WithinRel(2, 1e-12));
    CHECK_THAT(read(session, "axle/rate"), WithinAbs(0, 1e-12));
    CHECK_THAT(read(session, "axle/one_way_force"), WithinRel(4, 1e-10));
    CHECK_THAT(session.energy().dissipation, WithinRel(1, 1e-8));
    CHECK_THAT(session.balance(), WithinAbs(0, 1e-8));
  });
  REQUIRE(events.size() == 1);
  CHECK_THAT(events[0].time, WithinRel(2, 1e-9));
}

TEST_CASE("an elastic one-way clutch winds up by the torque that it holds, and gives its energy back") {
  // Started forwards at 1 rad/s against 4 N m, the wheel is at rest after 0.5 s and 0.25 rad. Then it oscillates about
  // 0.25 - 4/k rad and comes to rest there by its damping.
  move_to(wheel("one_way: {stiffness: 800, damping: 40}", 1, "-4"), 2e-3, 3, [](const Session& session) {
    CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0.25 - 4.0 / 800, 1e-8));
    CHECK_THAT(read(session, "axle/one_way_force"), WithinRel(4, 1e-5));
    CHECK_THAT(session.balance(), WithinAbs(0, 0.01 * 1.6e-3));  // 4^2/(2 k) = 0.01 J, (w h)^2
  });
  // The clutch releases a wheel that begins at rest: 2 rad after 1 s forwards and 1 s of braking.
  move_to(wheel("one_way: {stiffness: 800, damping: 40}", 0, "if(t < 1, 4, -4)"), 2e-3, 5,
          [](const Session& session) { CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(2 - 4.0 / 800, 1e-6)); });
  // A following motion begins with the clutch's present wind-up.
  {
    const auto file = bielle::mechanism::read_mechanism_text(wheel("one_way: {stiffness: 800}", 1, "-4"), "model.yaml");
    Session session(file.model);
    bielle::mechanism::DynamicsOptions options;
    options.stepping.size = 1e-3;
    for (const double duration : {0.6, 0.15}) {  // at rest after 0.5 s; the period of its oscillation is 0.314 s
      options.duration = duration;
      session.dynamics(options).finish();
    }
    // From 0.25 rad on p = (4/k) (1 - cos(20 (t - 0.5))).
    CHECK_THAT(read(session, "axle/coordinate"), WithinAbs(0.25 - 4.0 / 800 * (1 - std::cos(20 * 0.25)), 1e-5));
  }
  // Without damping, the torque is -4 + 2 t: the clutch opens, and no energy is lost.
  const auto events = events_of(wheel("one_way: {stiffness: 800}", 1, "-4 + 2*t"), 1e-3, 4, [](const Session& session) {
    CHECK_THAT(session.energy().dissipation, WithinAbs(0, 1e-12));
    CHECK_THAT(session.balance(), WithinAbs(0, 1e-5));
  });
  CHECK(events.size() >= 2);
}

TEST_CASE("clutches yield to drives of the same motion, and wrong starts are told") {
  const std::string load = R"(drives: {load: {joint: axle, torque: "0"}})", brake = "clutch: {capacity: 5}";
  const auto driven = [&](const std::string& angle) {
    std::string text = wheel(brake, 0, "0");
    const std::string start = "start_rate: 0, ";
    text.replace(text.find(start), start.size(), "");
    return text.replace(text.find(load), load.size(), "drives: {motor: {joint: axle, angle: \"" + angle + "\"}}");
  };
  move_to(driven("0.5*t^2"), 0.01, 1, [](const Session& session) {
    CHECK_THAT(read(session, "axle/drive_force"), WithinRel(2 + 5, 1e-9));
    CHECK_THAT(read(session, "axle/clutch_force"), WithinRel(-5, 1e-12));
  });
  move_to(driven("0"), 0.01, 1, [](const Session& session) {
    CHECK_THAT(read(session, "axle/drive_force"), WithinAbs(0, 1e-12));
    CHECK_THAT(read(session, "axle/clutch_force"), WithinAbs(0, 1e-12));
  });
  CHECK_THROWS_WITH(move_to(wheel("one_way: {direction: forwards}", -1, "0"), 0.01, 0.1, [](const Session&) {}),
                    Contains("holds against a rate of -1 rad/s"));
  CHECK_THROWS_WITH(move_to(wheel("clutch: {capacity: 1 - t}", 1, "3"), 0.01, 2, [](const Session&) {}),
                    Contains("must not be negative"));
}

}  // namespace test_clutches
