// A block on an incline: it sticks below the angle of friction and slides by the closed form above it, with each law.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move_to;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_block {
namespace {

constexpr double m = 2, g = 9.81;

/// The force acts down the slope of tan(angle) = 0.2, to the right.
std::string block(const std::string& friction, const std::string& more = "") {
  return fmt::format(
      "gravity: [0, 0, -9.81]\n"
      "nodes: {{block: {{position: [0, 0, 0]{}}}}}\n"
      "elements: {{block: {{type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}}}\n"
      "joints: {{slope: {{type: prismatic, nodes: [ground, block], axis: [1, 0, -0.2], friction: {{{}}}}}}}\n",
      more, friction);
}

const double angle = std::atan(0.2), N = m * g * std::cos(angle), pull = m * g * std::sin(angle);
const std::string bristles = "model: lugre, bristle_stiffness: 2e4, bristle_damping: 300, ";

double read(const Session& session, const char* what) { return session.read(std::string("joints/slope/") + what)[0]; }

}  // namespace

TEST_CASE("below the angle of friction a block sticks truly, or creeps as documented") {
  move_to(block("model: stick_slip, coefficient: 0.21"), 0.01, 10, [](const Session& session) {
    CHECK_THAT(read(session, "coordinate"), WithinAbs(0, 1e-15));
    CHECK_THAT(read(session, "friction"), WithinRel(-pull, 1e-12));
    CHECK(read(session, "sticks") == 1);
  });
  // With bristles, N sigma_0 z = pull; after one second they do not move for a thousand seconds.
  double early = 0;
  move_to(block(bristles + "coefficient: 0.25"), 1e-3, 1,
          [&](const Session& session) { early = read(session, "coordinate"); });
  // On the way there z' = v (1 - z/z_s), z_s = mu/sigma_0, at least; the damping lets the block move slightly farther.
  const double z = pull / (N * 2e4), z_s = 0.25 / 2e4;
  CHECK_THAT(early, WithinRel(-z_s * std::log(1 - z / z_s), 0.2));
  move_to(block(bristles + "coefficient: 0.25"), 1e-2, 1000, [&](const Session& session) {
    CHECK_THAT(read(session, "bristles"), WithinRel(z, 1e-9));
    CHECK_THAT(read(session, "rate"), WithinAbs(0, 1e-13));  // 1e-10 m during the whole time
  });
  // With regularised friction the speed is v_0 atanh(pull/(mu N)).
  move_to(block("coefficient: 0.25, velocity: 1e-4"), 0.01, 10, [](const Session& session) {
    CHECK_THAT(read(session, "rate"), WithinRel(1e-4 * std::atanh(0.2 / 0.25), 1e-6));
    CHECK_THAT(read(session, "friction"), WithinRel(-pull, 1e-6));
  });
}

TEST_CASE("above the angle of friction a block slides by the closed form") {
  const double mu = 0.15, a = g * (std::sin(angle) - mu * std::cos(angle));
  move_to(block("model: stick_slip, coefficient: 0.15"), 0.02, 2, [&](const Session& session) {
    CHECK_THAT(read(session, "coordinate"), WithinRel(0.5 * a * 4, 1e-10));  // the scheme is exact for it
    CHECK_THAT(read(session, "normal_force"), WithinRel(N, 1e-10));
    CHECK(read(session, "sticks") == 0);
    CHECK_THAT(session.balance(), WithinAbs(0, 1e-10));
  });
  // With regularised friction the force is not saturated while v < 3 v_0 or so. Bristles need mu/sigma_0 to bend, and
  // their damping takes an impulse N sigma_1 mu/sigma_0.
  move_to(block("coefficient: 0.15, velocity: 1e-4"), 1e-3, 2,
          [&](const Session& session) { CHECK_THAT(read(session, "rate"), WithinAbs(2 * a, 1e-3)); });
  move_to(block(bristles + "coefficient: 0.15"), 1e-3, 2, [&](const Session& session) {
    CHECK_THAT(read(session, "rate"), WithinAbs(2 * a, N / m * 300 * 0.15 / 2e4));
    CHECK_THAT(read(session, "friction"), WithinRel(-0.15 * N, 1e-9));
  });
}

TEST_CASE("viscous friction on a slope lets a block come to its speed exponentially") {
  // v' = a - v/tau with a = g (sin - mu cos) and 1/tau = sigma_2 g cos. The scheme's error is of the order of
  // (h/tau)^2.
  const double mu = 0.15, viscous = 0.1, h = 5e-3, end = 2;
  const double a = g * (std::sin(angle) - mu * std::cos(angle)), tau = 1 / (viscous * g * std::cos(angle));
  const double v = a * tau * (1 - std::exp(-end / tau)), x = tau * (a * end - v);
  move_to(block("model: stick_slip, coefficient: 0.15, viscous: 0.1"), h, end, [&](const Session& session) {
    CHECK_THAT(read(session, "rate"), WithinRel(v, h * h / (tau * tau)));
    CHECK_THAT(read(session, "coordinate"), WithinRel(x, h * h / (tau * tau)));
    CHECK_THAT(read(session, "friction"), WithinRel(-N * (mu + viscous * read(session, "rate")), 1e-9));
  });
}

TEST_CASE("a block that is thrown uphill comes to rest and stays, or slides back") {
  // Upwards a = -g (sin + mu cos); the block is at rest after v/|a|.
  const double v = 1.5;
  const auto thrown = [&](const std::string& friction, double end, const auto& look) {
    const std::string velocity =
        fmt::format(", velocity: [{:.17g}, 0, {:.17g}]", -v * std::cos(angle), v * std::sin(angle));
    move_to(block(friction, velocity), 0.013, end, look);
  };
  thrown("model: stick_slip, coefficient: 0.3, static: 0.4", 2, [&](const Session& session) {
    const double a = g * (std::sin(angle) + 0.3 * std::cos(angle));
    CHECK_THAT(read(session, "coordinate"), WithinRel(-v * v / (2 * a), 1e-8));
    CHECK_THAT(read(session, "rate"), WithinAbs(0, 1e-12));
  });
  thrown("model: stick_slip, coefficient: 0.1", 2, [&](const Session& session) {
    const double up = g * (std::sin(angle) + 0.1 * std::cos(angle)), t = v / up;
    const double down = g * (std::sin(angle) - 0.1 * std::cos(angle)), left = 2 - t;
    CHECK_THAT(read(session, "coordinate"), WithinAbs(-v * v / (2 * up) + 0.5 * down * left * left, 1e-8));
    CHECK_THAT(read(session, "rate"), WithinRel(down * left, 1e-8));
  });
}

// Bristles bend by dz = dx (1 - z/z_s) on the way down and straighten by dz = dx (1 + z/z_s), z > 0, on the way up, a
// known property of the law (P. Dupont et al., IEEE Trans. Automatic Control 47 (2002) 787-792). A slow force between
// the fractions f_1 and f_2 of the slip force moves the block in each period by
//     z_s [ln((1 - f_1)/(1 - f_2)) - ln((1 + f_2)/(1 + f_1))].
TEST_CASE("a force that swings moves bristles by the drift of their law, and no block that sticks by Coulomb's") {
  const double mu = 0.29, swing = 1.5 / std::cos(angle), f_1 = (pull - swing) / (mu * N),
               f_2 = (pull + swing) / (mu * N);
  REQUIRE(f_2 < 1);
  const std::string load = "loads: {swing: {node: block, force: [\"1.5*sin(2*t)\", 0, \"-0.3*sin(2*t)\"]}}\n";
  const double period = M_PI, h = period / 500;
  move_to(block("model: stick_slip, coefficient: 0.29") + load, h, 4 * period,
          [](const Session& session) { CHECK_THAT(read(session, "coordinate"), WithinAbs(0, 1e-13)); });
  const auto after = [&](int periods) {
    double place = 0;
    move_to(block(bristles + "coefficient: 0.29") + load, h, periods * period,
            [&](const Session& session) { place = read(session, "coordinate"); });
    return place;
  };
  const double z_s = mu / 2e4, drift = z_s * (std::log((1 - f_1) / (1 - f_2)) - std::log((1 + f_2) / (1 + f_1)));
  CHECK_THAT((after(4) - after(2)) / 2, WithinRel(drift, 0.01));
}

}  // namespace test_block
