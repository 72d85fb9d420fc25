// Valves whose openings events lock and unlock.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::run_hydraulics;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_locked_valves {
namespace {

constexpr double locked_at = 0.4137, unlocked_at = 0.7;

/// Returns a valve between two supplies.
std::string valve(const std::string& keys, const std::string& more = "",
                  const std::string& events =
                      "shut: {when: clock, crosses: 0.4137, do: [{lock: gate}]}, open: {when: "
                      "clock, crosses: 0.7, do: [{unlock: gate}]}") {
  return R"yaml(
hydraulics:
  fluid: {density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}
  supplies: {pump: {pressure: 3e5}, tank: {pressure: 1e5}}
  lines:
    gate: {from: pump, to: tank, valve: {diameter: 1e-3, )yaml" +
         keys + "}}\nmeasures: {seen: gate.opening, flow: gate.flow}\nstates: {clock: {rate: 1}}\nevents: {" + events +
         "}\n" + more;
}

/// Returns the largest error of the opening, compared with its closed form after each step.
double error_of_opening(const std::string& text, double h, const std::function<double(double)>& exact) {
  double most = 0;
  run_hydraulics(text, {.h = h, .end = 1, .rho = 1}, [&](const Session& session) {
    const double y = session.read("hydraulics/gate/opening")[0];
    CHECK(session.measure("seen") == y);
    most = std::max(most, std::abs(y - exact(session.time())));
  });
  return most;
}

}  // namespace
}  // namespace test_locked_valves
using namespace test_locked_valves;

TEST_CASE("a locked valve keeps its opening, and follows its command again when it is unlocked") {
  const auto command = [](double t) { return 0.2 + 0.5 * t; };
  // A row on an event has the opening just before it.
  const auto exact = [&](double t) { return command(t <= locked_at + 1e-9 || t > unlocked_at + 1e-9 ? t : locked_at); };
  CHECK(error_of_opening(valve("command: \"0.2 + 0.5*t\""), 0.01, exact) < 1e-12);
}

TEST_CASE("the dynamics of a locked spool wait, and go on from the opening that was kept") {
  constexpr double T = 0.1, rate = 0.5;
  const auto command = [](double t) { return 0.2 + rate * t; };
  const auto before = [&](double t) { return command(t) - rate * T * (1 - std::exp(-t / T)); };
  const double kept = before(locked_at);
  const auto exact = [&](double t) {
    if (t <= locked_at) return before(t);
    if (t <= unlocked_at) return kept;
    const double steady = command(unlocked_at) - rate * T;
    return command(t) - rate * T + (kept - steady) * std::exp(-(t - unlocked_at) / T);
  };
  const std::string text = valve("command: \"0.2 + 0.5*t\", time_constant: 0.1");
  // The trapezoidal rule has the error d (h/T)^2/12 t/T exp(-t/T) in a decay from d, at most at t = T.
  const double h = 0.01, coarse = error_of_opening(text, h, exact), fine = error_of_opening(text, h / 2, exact);
  const double away = command(unlocked_at) - rate * T - kept;
  CHECK(coarse == Approx(away * h * h / (T * T) / 12 * std::exp(-1)).epsilon(0.05));
  CHECK(coarse / fine == Approx(4).epsilon(0.02));
}

TEST_CASE("a spool of second order stands when it is unlocked, although it moved when it was locked") {
  // The command jumps from 0.2 to 0.8 at 0.35: the spool moves fast at 0.4137.
  constexpr double omega = 2 * M_PI * 3, zeta = 0.3;
  const double damped = omega * std::sqrt(1 - zeta * zeta);
  const auto response = [&](double t) {  // to a unit step, from rest
    return 1 - std::exp(-zeta * omega * t) * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
  };
  const double kept = 0.2 + 0.6 * response(locked_at - 0.35);
  REQUIRE((kept > 0.4 && kept < 0.7));
  const auto exact = [&](double t) {
    if (t <= 0.35) return 0.2;
    if (t <= locked_at) return 0.2 + 0.6 * response(t - 0.35);
    return t <= unlocked_at ? kept : kept + (0.8 - kept) * response(t - unlocked_at);
  };
  const std::string text =
      valve("command: u, frequency: 3, damping: 0.3", "inputs: {u: 0.2}\n",
            "jump: {when: clock, crosses: 0.35, do: [{set: {u: 0.8}}]}, shut: {when: clock, "
            "crosses: 0.4137, do: [{lock: gate}]}, open: {when: clock, crosses: 0.7, do: [{unlock: "
            "gate}]}");
  const double coarse = error_of_opening(text, 0.004, exact), fine = error_of_opening(text, 0.002, exact);
  CHECK(coarse < 1e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("actions of an instant lock a valve in the order of the list") {
  const auto openings = [](const std::string& actions) {
    std::vector<double> values;
    run_hydraulics(
        valve("command: u", "inputs: {u: 0.3}\n", "once: {when: clock, crosses: 0.5, do: [" + actions + "]}"),
        {.h = 0.01, .end = 1}, [&](const Session& session) { values.push_back(session.measure("seen")); });
    CHECK(values.front() == 0.3);
    return values.back();
  };
  CHECK(openings("{lock: gate}, {set: {u: 0.8}}") == 0.3);
  CHECK(openings("{set: {u: 0.8}}, {lock: gate}") == 0.8);
  CHECK(openings("{lock: gate}, {set: {u: 0.8}}, {unlock: gate}") == 0.8);
  CHECK(openings("{unlock: gate}, {set: {u: 0.8}}") == 0.8);
  CHECK(openings("{lock: gate}, {set: {u: 0.8}}, {lock: gate}") == 0.8);
}

TEST_CASE("the command of a locked valve may leave its range, that of an unlocked one may not") {
  const std::string beyond = "command: \"0.2 + 2*t\"";
  run_hydraulics(valve(beyond, "", "shut: {when: clock, crosses: 0.3, do: [{lock: gate}]}"), {.h = 0.01},
                 [](const Session& session) { CHECK(session.measure("seen") <= 0.8 + 1e-9); });
  CHECK_THAT(message_of<bielle::ComputationError>([&] {
               run_hydraulics(valve(beyond, "",
                                    "shut: {when: clock, crosses: 0.3, do: [{lock: gate}]}, open: {when: clock, "
                                    "crosses: 0.6, do: [{unlock: gate}]}"),
                              {.h = 0.01});
             }),
             Contains("command of valve 'gate'"));
}

TEST_CASE("a relief valve that sticks passes fluid at pressures at which it would be closed") {
  // The valve opens over a difference of 2 to 4 bar; at 3 bar it is half open.
  for (const char* constant : {"", ", time_constant: 0.02"}) {
    const std::string text = fmt::format(R"yaml(
hydraulics:
  fluid: {{density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}}
  supplies: {{pump: {{pressure: "4e5 - 2.5e5*min(1, max(0, 2*t - 1))"}}, tank: {{pressure: 1e5}}}}
  lines:
    gate: {{from: pump, to: tank, relief: {{diameter: 1e-3, pressure: 2e5, range: 2e5{}}}}}
    half: {{from: pump, to: tank, orifice: {{area: "pi/4*1e-6/2"}}}}
measures: {{seen: gate.opening}}
states: {{clock: {{rate: 1}}}}
events: {{shut: {{when: clock, crosses: 0.3, do: [{{lock: gate}}]}}}}
)yaml",
                                         constant);
    run_hydraulics(text, {.h = 0.01, .end = 1.2}, [&](const Session& session) {
      CHECK(session.measure("seen") == Approx(0.5).epsilon(1e-9));
      CHECK(session.read("hydraulics/gate/flow")[0] == Approx(session.read("hydraulics/half/flow")[0]).epsilon(1e-9));
    });
  }
}

TEST_CASE("a locked valve stays so in the analyses that follow, and in a saved motion to the last bit") {
  for (const char* dynamics : {"", ", time_constant: 0.1", ", frequency: 3"}) {
    const std::string text = valve(std::string("command: \"0.2 + 0.5*t\"") + dynamics);
    Session session = session_of(text);
    session.dynamics(steps_of(0.5, 0.01)).finish();
    const double kept = session.measure("seen");
    CHECK(kept > 0.3);
    compute_statics(session, {});
    CHECK(session.measure("seen") == kept);
    session.dynamics(steps_of(0.1, 0.01)).finish();
    CHECK(session.measure("seen") == Approx(kept).epsilon(1e-14));

    Session whole = session_of(text), other = session_of(text);
    Motion motion = whole.dynamics(steps_of(1, 0.01));
    motion.advance_to(0.55);
    const std::vector<double> saved = whole.save();
    motion.finish();
    Motion again = other.dynamics(steps_of(1, 0.01), saved);
    CHECK(other.measure("seen") == Approx(kept).epsilon(1e-14));
    again.finish();
    CHECK(other.measure("seen") == whole.measure("seen"));
    CHECK(other.measure("seen") > 0.6);
  }
}

TEST_CASE("places and lines without an opening of their own cannot be locked") {
  const auto refusal = [](const std::string& name) {
    return message_of<bielle::InputError>([&] {
      session_of(valve("command: 0.5}}\n    thin: {from: pump, to: tank, orifice: {diameter: 1e-3", "",
                       "shut: {when: clock, crosses: 0.5, do: [{lock: " + name + "}]}"));
    });
  };
  CHECK(refusal("gate") == "(nothing thrown)");
  CHECK_THAT(refusal("pump"), Contains("'pump' has no opening that could be locked"));
  CHECK_THAT(refusal("thin"), Contains("events.shut.do") && Contains("'thin' has no opening that could be locked"));
  CHECK_THAT(refusal("gat"), Contains("no joint with coordinates, or valve, 'gat'; did you mean 'gate'"));
}
