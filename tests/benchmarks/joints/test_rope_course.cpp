// Ropes that leave their pulleys and come back onto them: the straight path and the path around the pulley are
// distinguished, in dynamics and in statics, and compared with plane geometry.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/model/component.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::move;
using bielle::test::move_to;
using Catch::Contains;
using Eigen::Vector2d;

namespace {

/// Returns the length of the shortest way from a to b round a disc, on the side of less than half a turn or, `far`, on
/// the other.
double taut_length(const Vector2d& a, const Vector2d& b, const Vector2d& centre, double radius, bool far = false) {
  const Vector2d to_a = a - centre, to_b = b - centre;
  const double angle = std::acos(to_a.dot(to_b) / (to_a.norm() * to_b.norm())),
               between = far ? 2 * M_PI - angle : angle, free_a = std::acos(radius / to_a.norm()),
               free_b = std::acos(radius / to_b.norm());
  const double wrap = between - free_a - free_b;
  if (wrap <= 0) return (b - a).norm();
  return radius * (std::tan(free_a) + std::tan(free_b) + wrap);
}

/// From a = (-1, 0) below a pulley of 0.1 m at (0, 0.05) to s = (1, 0), which moves along z.
std::string lowered(const std::string& z, double radius = -0.1, double height = 0.05, const std::string& more = "") {
  return fmt::format(R"yaml(
nodes:
  a: {{position: [-1, 0, 0], fixed: true}}
  p: {{position: [0, 0, {}], fixed: true}}
  s: {{position: [1, 0, 0], motion: {{x: 0, y: 0, z: "{}", rx: 0, ry: 0, rz: 0}}}}
joints:
  rope: {{type: cable, nodes: [a, p, s], radii: [0, {}, 0], axis: [0, 1, 0], EA: 1e5{}}}
)yaml",
                     height, z, radius, more);
}

struct Run {
  std::vector<Event> events;
  double balance = 0, energy = 0;
};

/// @param look  after every step
Run run(const std::string& text, double h, double end, const std::function<void(const Session&)>& look = {}) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  Run result;
  session.on_event([&](const Event& event) {
    if (event.name.find("pulley") != std::string::npos) result.events.push_back(event);
  });
  DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  while (motion.step())
    if (look) look(session);
  result.balance = motion.balance();
  result.energy = session.energy().kinetic + session.energy().elastic;
  return result;
}

/// s has this value when the straight rope touches the pulley, so that the distance of its centre is its radius.
const double touching = (std::sqrt(0.1588) - 0.2) / 1.98;  // 0.99 d^2 + 0.2 d - 0.03 = 0

}  // namespace

TEST_CASE("a rope leaves a pulley round which it bends no more, runs straight, and comes back onto it") {
  const double drawn = taut_length({-1, 0}, {1, 0}, {0, 0.05}, 0.1);
  const auto look = [&](const Session& session) {
    const double L = taut_length({-1, 0}, {1, session.node("s").x.z()}, {0, 0.05}, 0.1), E = L - drawn;
    CHECK(session.read("joints/rope/length")[0] == Approx(L).epsilon(1e-10));
    CHECK(session.read("joints/rope/tension")[0] == Approx(std::max(0.0, 1e5 * E / drawn)).margin(1e-5));
  };
  // The end s stays down: the rope is straight at the end.
  const Run down = run(lowered("-0.5*t"), 0.01, 1, look);
  REQUIRE(down.events.size() == 1);
  CHECK(down.events[0].time == Approx(touching / 0.5).epsilon(1e-7));
  CHECK_THAT(down.events[0].name, Contains("joint 'rope': leaves pulley 'p'"));
  // And back.
  const Run back = run(lowered("-0.5*sin(pi*t)"), 0.01, 1, look);
  REQUIRE(back.events.size() == 2);
  CHECK(back.events[0].time == Approx(std::asin(touching / 0.5) / M_PI).epsilon(1e-7));
  CHECK(back.events[1].time == Approx(1 - back.events[0].time).epsilon(1e-7));
  CHECK_THAT(back.events[1].name, Contains("joint 'rope': comes onto pulley 'p'"));
}

TEST_CASE("the energy of a rope that leaves its pulley and comes back is kept to second order") {
  // The rope stores the work of the motion.
  const auto balance = [](double h) { return std::abs(run(lowered("-0.5*sin(pi*t)^2"), h, 1).balance); };
  CHECK(balance(0.01) < 1e-3 * 220);
  CHECK(balance(0.01) / balance(0.005) > 3);
}

TEST_CASE("a rope that is drawn clear of its pulley begins straight and says so") {
  // The pulley's rim is 0.1 m above the rope, which s brings up to it.
  for (const double radius : {-0.1, 0.1}) {
    CAPTURE(radius);
    const MechanismFile file = read_mechanism_text(lowered("1*t", radius, radius < 0 ? 0.2 : -0.2), "model.yaml");
    std::string remark;
    for (const Member& member : file.model.members())
      if (member.entry.name == "rope") remark += member.component->remark();
    CHECK_THAT(remark, Contains("drawn 0.1 m clear of pulley 'p'") &&
                           Contains(fmt::format("a radius of {} m would turn round it as drawn", -radius)));
  }
  const Run up = run(lowered("t", -0.1, 0.2), 0.01, 1, [](const Session& session) {
    const double z = session.node("s").x.z(), L = taut_length({-1, 0}, {1, z}, {0, 0.2}, 0.1, z > 0.4);
    CHECK(session.read("joints/rope/length")[0] == Approx(L).epsilon(1e-10));
  });
  REQUIRE(up.events.size() == 1);
  CHECK_THAT(up.events[0].name, Contains("comes onto pulley 'p'"));
  // (0.2 - z/2)/sqrt(1 + z^2/4) = 0.1 with w = z/2: 0.99 w^2 - 0.4 w + 0.03 = 0
  CHECK(up.events[0].time == Approx(2 * (0.4 - std::sqrt(0.16 - 0.1188)) / 1.98).epsilon(1e-8));
}

TEST_CASE("a pendulum on a rope winds round a peg and unwinds, to either side, and keeps its energy") {
  // The peg is below the rope's upper end; the rope passes it on the side on which the mass begins.
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    const std::string text = fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  top: {{fixed: true}}
  peg: {{position: [0, 0, -0.5], fixed: true}}
  mass: {{position: [{:.17g}, 0, -0.8], fixed: [y, rx, ry, rz]}}
elements: {{m: {{type: point_mass, node: mass, mass: 2}}}}
joints: {{rope: {{type: cable, nodes: [top, peg, mass], radii: [0, {:.17g}, 0], axis: [0, 1, 0], EA: 2e4, pretension: 16}}}}
)yaml",
                                         0.6 * side, 0.05 * side);
    // 16 N in a rope of 1 m.
    const double at_start = 2 * 9.81 * -0.8 + 0.5 * 16 * 16 / (2e4 + 16);
    std::vector<double> errors;
    for (const double h : {1e-3, 5e-4}) {
      double worst = 0, farthest = 0;
      const Run swing = run(text, h, 1.5, [&](const Session& session) {
        const Vector2d x(session.node("mass").x.x(), session.node("mass").x.z());
        CHECK(session.read("joints/rope/length")[0] ==
              Approx(taut_length({0, 0}, x, {0, -0.5}, 0.05, side * x.x() < 0)).epsilon(1e-9));
        const Energy energy = session.energy();
        worst = std::max(worst, std::abs(energy.kinetic + energy.elastic + energy.gravity - at_start));
        farthest = std::max(farthest, -side * x.x());
      });
      REQUIRE(swing.events.size() >= 2);
      CHECK_THAT(swing.events[0].name, Contains("comes onto pulley 'peg'"));
      CHECK_THAT(swing.events[1].name, Contains("leaves pulley 'peg'"));
      CHECK(farthest > 0.3);
      errors.push_back(worst);
    }
    CHECK(errors[1] < 0.02);
    CHECK(errors[0] / errors[1] > 3);
  }
}

TEST_CASE("a rope round many turns unwinds, leaves its pulley, and comes onto it the other way round") {
  // s moves round the pulley at 1 m; the wrap decreases at the rate of the turn.
  const double r = 0.1, angle = 0.3;  // angle of the turn by which s begins beyond the point of zero wrap
  // a is far to the left on the tangent of the pulley's lowest point: its rope is along +x at z = -r.
  const auto text = [&](double turns, double speed) {
    const double begin = std::acos(r) - M_PI / 2 + angle;  // direction of s about -y, from +x
    return fmt::format(R"yaml(
nodes:
  a: {{position: [-1, 0, -0.1], fixed: true}}
  p: {{fixed: true}}
  s: {{position: [{:.17g}, 0, {:.17g}], motion: {{x: "cos({:.17g} - {:.17g}*t) - cos({:.17g})", y: 0,
      z: "sin({:.17g} - {:.17g}*t) - sin({:.17g})", rx: 0, ry: 0, rz: 0}}}}
joints:
  rope: {{type: cable, nodes: [a, p, s], radii: [0, -0.1, 0], axis: [0, 1, 0], EA: 10, turns: [~, {}, ~]}}
)yaml",
                       std::cos(begin), std::sin(begin), begin, speed, begin, begin, speed, begin, turns);
  };
  const Run unwound = run(text(2, 1), 0.05, 4 * M_PI + angle + 0.5, [&](const Session& session) {
    const double wrap = angle + 4 * M_PI - session.time();
    if (wrap > 0)
      CHECK(session.read("joints/rope/length")[0] == Approx(1 + std::sqrt(1 - r * r) + r * wrap).epsilon(1e-9));
    else
      CHECK(session.read("joints/rope/length")[0] ==
            Approx((session.node("s").x - Vector3(-1, 0, -0.1)).norm()).epsilon(1e-9));
  });
  REQUIRE(unwound.events.size() == 1);
  CHECK(unwound.events[0].time == Approx(angle + 4 * M_PI).epsilon(1e-8));
  // After one turn round the pulley, the rope meets it from its other side, where the tangents of the top meet again.
  const Run round = run(text(0, 1), 0.01, 6.35, [&](const Session& session) {
    const Vector2d s(session.node("s").x.x(), session.node("s").x.z());
    const double L = session.read("joints/rope/length")[0];
    CHECK(L == Approx(taut_length({-1, -0.1}, s, {0, 0}, r, session.time() < 0.1001)).epsilon(1e-9));
  });
  REQUIRE(round.events.size() == 2);
  CHECK_THAT(round.events[1].name, Contains("comes onto pulley 'p'"));
}

TEST_CASE("a rope touches the pulleys round which it bends, and no others, in statics and in motion") {
  // Below three pulleys; the end s goes down and to the right, so that the rope leaves them one after the other. The
  // shortest way below discs is the lower hull of their points.
  const std::vector<Vector2d> centres = {{0, 0.2}, {0.6, 0.1}, {1.3, 0.25}};
  const std::vector<double> radii = {0.1, 0.15, 0.05};
  const auto text = [](const char* x, const char* z) {
    return fmt::format(R"yaml(
nodes:
  a: {{position: [-1, 0, 0.6], fixed: true}}
  p: {{position: [0, 0, 0.2], fixed: true}}
  q: {{position: [0.6, 0, 0.1], fixed: true}}
  r: {{position: [1.3, 0, 0.25], fixed: true}}
  s: {{position: [2, 0, 0.7], motion: {{x: "{}", y: 0, z: "{}", rx: 0, ry: 0, rz: 0}}}}
joints:
  rope: {{type: cable, nodes: [a, p, q, r, s], radii: [0, -0.1, -0.15, -0.05, 0], axis: [0, 1, 0], EA: 1e5, pretension: 10}}
)yaml",
                       x, z);
  };
  const auto hull = [&](const Vector2d& a, const Vector2d& s) {
    std::vector<Vector2d> points = {a, s};
    constexpr int count = 4000;
    for (std::size_t d = 0; d < centres.size(); ++d)
      for (int k = 0; k <= count; ++k) {
        const double angle = M_PI + M_PI * k / count;
        points.push_back(centres[d] + radii[d] * Vector2d(std::cos(angle), std::sin(angle)));
      }
    std::sort(points.begin(), points.end(), [](const Vector2d& u, const Vector2d& v) { return u.x() < v.x(); });
    std::vector<Vector2d> lower;
    for (const Vector2d& point : points) {
      const auto turns = [&] {
        const Vector2d u = lower.back() - lower[lower.size() - 2], v = point - lower.back();
        return u.x() * v.y() - u.y() * v.x();
      };
      while (lower.size() > 1 && turns() <= 0) lower.pop_back();
      lower.push_back(point);
    }
    double length = 0;
    for (std::size_t k = 1; k < lower.size(); ++k) length += (lower[k] - lower[k - 1]).norm();
    return length;
  };
  const MechanismFile file = read_mechanism_text(text("0.1", "-2.4"), "model.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.steps = 16;
  std::vector<double> lengths;
  session.on_step([&](const Session& at) {
    const Vector3 s = at.node("s").x;
    lengths.push_back(at.read("joints/rope/length")[0]);
    CHECK(lengths.back() == Approx(hull({-1, 0.6}, {s.x(), s.z()})).epsilon(1e-6));
  });
  compute_statics(session, options);
  REQUIRE(lengths.size() >= 16);
  CHECK(lengths.back() == Approx(std::hypot(3.1, 2.3)).epsilon(1e-12));  // clear of all
  // s moves down and up again: the rope leaves each pulley once and returns to it.
  const Run there_and_back = run(text("0.1*sin(pi*t)", "-2.4*sin(pi*t)"), 0.02, 1, [&](const Session& at) {
    const Vector3 end = at.node("s").x;
    CHECK(at.read("joints/rope/length")[0] == Approx(hull({-1, 0.6}, {end.x(), end.z()})).epsilon(1e-6));
  });
  REQUIRE(there_and_back.events.size() == 6);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK_THAT(there_and_back.events[k].name, Contains("leaves"));
    CHECK_THAT(there_and_back.events[3 + k].name, Contains("comes onto"));
    CHECK(there_and_back.events[5 - k].time == Approx(1 - there_and_back.events[k].time).epsilon(1e-7));
  }
}

TEST_CASE("a belt that would leave a pulley which it grips says so") {
  // The idler presses on the span between a and b from outside, and moves away.
  const std::string text = R"yaml(
nodes:
  a: {fixed: true}
  b: {position: [1, 0, 0], fixed: true}
  i: {position: [0.5, 0, 0.17], motion: {x: 0, y: 0, z: "0.1*t", rx: 0, ry: 0, rz: 0}}
joints:
  belt: {type: belt, nodes: [a, i, b], radii: [0.1, -0.1, 0.1], axis: [0, 1, 0], EA: 1e4, pretension: 100}
)yaml";
  const Run away = run(text, 0.01, 1);
  REQUIRE(away.events.size() == 1);
  CHECK_THAT(away.events[0].name, Contains("joint 'belt': leaves pulley 'i', which it grips"));
  CHECK(away.events[0].time == Approx(0.3).epsilon(1e-8));  // its rim at the height of the straight span
}
