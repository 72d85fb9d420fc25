// Steps end at the begin and end of contact, and the scheme keeps its order: a constant force pushes a coordinate
// against a stop of spring and damper, which throws it back, against the closed form.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/bounce.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::Bounce;
using bielle::test::steps_of;

namespace test_stops {
namespace {

/// The scheme is exact for it as long as only its weight acts. Weight acts along +q.
const std::string falling = R"yaml(
gravity: [0, 0, -9.81]
nodes: {ball: {position: [0, 0, 2]}}
elements: {ball: {type: rigid_body, node: ball, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {path: {type: prismatic, nodes: [ground, ball], axis: [0, 0, -1], stops: {range: [~, 0.3], stiffness: 1800, damping: 12}}}
)yaml";
Bounce fall() { return {0.3, 9.81, std::sqrt(1800 / 2.0), 12 / 2.0 / 2}; }

/// The same model with a hinge at a distance from the body's centre: J = 0.5 + 2 0.6^2, and reactions that turn.
const std::string turning = R"yaml(
nodes: {arm: {position: [0.6, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.3, 0.3, 0.5]}}
joints: {path: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1], stops: {range: [-7, 0.3], stiffness: 1100, damping: 7.32}}}
drives: {push: {joint: path, torque: "12.2"}}
)yaml";
constexpr double inertia = 0.5 + 2 * 0.36;
Bounce turn() { return {0.3, 12.2 / inertia, std::sqrt(1100 / inertia), 7.32 / inertia / 2}; }

struct Ran {
  Bounce::Point end;
  std::vector<Event> events;
  std::vector<double> time;
  double balance;
};

Ran run(const std::string& text, const DynamicsOptions& options) {
  Session session(read_mechanism_text(text, "model.yaml").model);
  MemorySink sink(session.model());
  session.add_sink(sink);
  session.begin_analysis("dynamic");
  Ran ran;
  session.on_event([&](const Event& event) { ran.events.push_back(event); });
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  ran.end = {session.read("joints/path/coordinate")[0], session.read("joints/path/rate")[0],
             session.read("joints/path/stop_force")[0]};
  ran.balance = session.balance();
  ran.time = sink.read(0, "time");
  session.end_analysis();
  return ran;
}

/// Returns the least-squares slope of log(error) over log(h).
double slope(const std::vector<double>& h, const std::vector<double>& error) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(h.size());
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double a = std::log(h[k]), b = std::log(error[k]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

TEST_CASE("the first contact is met to the tolerance of its search, at steps that do not divide its time") {
  Bounce exact = fall();
  const double met = exact.events(0.3).front();
  for (const double h : {0.1, 0.0137, 1e-3}) {
    const Ran ran = run(falling, steps_of(0.3, h));
    REQUIRE(!ran.events.empty());
    CHECK(ran.events.front().name == "joint 'path': displacement at its upper stop");
    // Steps end past the zero, by less than 1e-10 of their size; positions of the fall are exact but for rounding.
    CHECK(ran.events.front().time == Approx(met).margin(1e-10 * h + 1e-14).epsilon(0));
  }
}

TEST_CASE("contact and what comes after are of order 2 in each form of constraints") {
  const auto form = GENERATE(ConstraintForm::position, ConstraintForm::corrected, ConstraintForm::stabilised);
  const bool turns = GENERATE(false, true);
  Bounce exact = turns ? turn() : fall();
  const double end = exact.events(1.15).at(4) + 0.03;  // in contact for the third time, pushed back
  const std::vector<double> events = exact.events(end);
  REQUIRE(events.size() == 5);
  const Bounce::Point wanted = exact.at(end);
  const double load = turns ? inertia : 2;
  std::vector<double> sizes, q, v, force, times;
  for (double steps = 120; steps <= 120 * 32; steps *= 2) {
    const Ran ran = run(turns ? turning : falling, steps_of(end, end / steps, form));
    REQUIRE(ran.events.size() == events.size());
    sizes.push_back(end / steps);
    q.push_back(std::abs(ran.end.q - wanted.q));
    v.push_back(std::abs(ran.end.v - wanted.v));
    force.push_back(std::abs(ran.end.stop - load * wanted.stop));
    times.push_back(0);
    for (std::size_t k = 1; k < events.size(); ++k)
      times.back() = std::max(times.back(), std::abs(ran.events[k].time - events[k]));
    UNSCOPED_INFO("h " << sizes.back() << ": q " << q.back() << ", v " << v.back() << ", force " << force.back()
                       << ", times " << times.back() << ", balance " << ran.balance);
  }
  // If the damper's force ends before contact ends, a step contains a kink at any place, which scatters the errors'
  // factor.
  for (const auto& errors : {q, v, force, times}) CHECK(slope(sizes, errors) == Approx(2).margin(0.15));
  CHECK(q.back() < 1e-5);
}

TEST_CASE("adaptive steps keep the errors after events in proportion to tolerance^(2/3)") {
  Bounce exact = turn();
  const double end = exact.events(1.15).at(4) + 0.03;
  const Bounce::Point wanted = exact.at(end);
  std::vector<double> tolerances, q;
  for (double tolerance = 1e-4; tolerance > 0.9e-8; tolerance /= 10) {
    DynamicsOptions options = steps_of(end, 1e-3);
    options.stepping.tolerance = tolerance;
    const Ran ran = run(turning, options);
    CHECK(ran.events.size() == 5);
    tolerances.push_back(tolerance);
    q.push_back(std::abs(ran.end.q - wanted.q));
    UNSCOPED_INFO(tolerance << ": " << q.back() << " in " << ran.time.size() << " rows");
  }
  CHECK(slope(tolerances, q) == Approx(2.0 / 3).margin(0.12));
}

TEST_CASE("the grid of fixed steps goes on after events") {
  const Ran ran = run(falling, steps_of(1.04, 0.01));
  REQUIRE(ran.time.size() == 105);
  for (std::size_t k = 0; k < ran.time.size(); ++k)
    CHECK(ran.time[k] == Approx(0.01 * static_cast<double>(k)).margin(1e-14).epsilon(0));
}

TEST_CASE("an undamped stop gives back what it took") {
  std::string text = falling;
  text.replace(text.find(", damping: 12"), 13, "");
  const double period = 2 * std::sqrt(2 * 0.3 / 9.81);  // duration of flight
  Bounce exact(0.3, 9.81, 30, 0);
  const std::vector<double> events = exact.events(2);
  CHECK(events[2] - events[1] == Approx(period).epsilon(1e-12));
  const Ran ran = run(text, steps_of(2, 2.5e-4));
  REQUIRE(ran.events.size() == events.size());
  // The stop's spring has 0.21 s a turn: (omega h)^2/12 = 5e-6 of the phase, and twice that at the rest's energy.
  for (std::size_t k = 0; k < events.size(); ++k) CHECK(ran.events[k].time == Approx(events[k]).margin(2e-5));
  CHECK(std::abs(ran.balance) < 1e-4 * 2 * 9.81 * 0.3);
}

TEST_CASE("what rests on a stop when the motion begins stays in contact") {
  // Exactly on the stop and at rest: the weight presses it in. p = g/omega^2 (1 - cos omega t).
  std::string text = falling;
  text.replace(text.find("[~, 0.3]"), 8, "[~, 0]");
  text.replace(text.find(", damping: 12"), 13, "");
  const double end = 0.5, h = 2.5e-4;
  const Ran ran = run(text, steps_of(end, h));
  const double size = 9.81 / 900;
  // The phase of 15 has an error of (omega h)^2/12, or 7e-5.
  CHECK(ran.end.q == Approx(size * (1 - std::cos(30 * end))).margin(2e-4 * size));
}

}  // namespace test_stops
