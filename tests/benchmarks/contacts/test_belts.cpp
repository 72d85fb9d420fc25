// Contacts with surfaces that move on their bodies, and rolling resistance, against closed forms.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_belts {

constexpr double radius = 0.1;  // a ball of 1 kg, J = 0.4 m r^2

/// Returns a ball on the ground, pressed in by its weight. @param node  further keys @param plane,contact  keys
std::string ball_on_ground(const std::string& node, const std::string& plane, const std::string& contact) {
  const double depth = std::pow(g / 1e9, 1 / 1.5);
  return contact_model(
      {{"ball", fmt::format("position: [0.2, 0, {:.17g}]{}", radius - depth, node)}},
      fmt::format("  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]{}}}, {{node: ball, "
                  "sphere: 0.1}}], stiffness: 1e9, damping: 0.5, friction: {{coefficient: 0.3, "
                  "velocity: 1e-4}}{}}}\n",
                  plane, contact),
      fmt::format("[0, 0, {}]", -g));
}

}  // namespace test_belts
using namespace test_belts;

TEST_CASE("a conveyor belt takes a block along with the force of friction, and puts in the energy") {
  // While it slips, the impulse of friction is mu times that of the normal force, m (g t + v_z), regardless of the
  // depth.
  for (const bool reversed : {false, true}) {
    const std::string belt = "{node: ground, plane: [0, 0, 1], velocity: [0.5, 0, 0]}",
                      block = "{node: block, box: [0.4, 0.3, 0.2]}";
    const std::string text =
        contact_model({{"block", "position: [0, 0, 0.1]", 2, {0.02, 0.02, 0.02}}},
                      "  it: {type: contact, shapes: [" + (reversed ? block + ", " + belt : belt + ", " + block) +
                          "], stiffness: 1e7, damping: 30, friction: {coefficient: 0.3, velocity: 1e-3}}\n",
                      "[0, 0, -9.81]");
    double late = 0, input = 0, missing = 0;
    run_contact(text, {2e-4, 0.4}, [&](const Session& session, const Motion& motion) {
      const Vector3 v = session.node("block").v;
      if (std::abs(session.time() - 0.1) < 1e-9) CHECK_THAT(v.x(), Catch::WithinRel(0.3 * (g * 0.1 + v.z()), 1e-6));
      late = v.x();
      input = motion.energy().input;
      missing = motion.balance();
    });
    CHECK_THAT(late, Catch::WithinAbs(0.5, 1e-4));
    // Half of the belt's work becomes heat, the other half kinetic energy of the block.
    CHECK_THAT(input, Catch::WithinRel(2 * 0.5 * 2 * 0.25, 1e-2));
    CHECK(std::abs(missing) < 1e-3 * input);
  }
}

TEST_CASE("a ball on a turntable goes round with 2/7 of its angular velocity") {
  // Reference: J. A. Burns, Ball rolling on a turntable: Analog for charged particle dynamics, Am. J. Phys. 49
  // (1981) 56.
  double before = 0, after = 0;
  run_contact(ball_on_ground("", ", angular_velocity: [0, 0, 2]", ""), {1e-3, 2},
              [&](const Session& session, const Motion&) {
                const Vector3 v = session.node("ball").v;
                const double direction = std::atan2(v.y(), v.x());
                if (std::abs(session.time() - 1) < 1e-9) before = direction;
                after = direction;
              });
  CHECK_THAT(std::remainder(after - before, 2 * M_PI), Catch::WithinRel(2. / 7 * 2, 1e-3));
}

TEST_CASE("rolling resistance slows a ball down by 5/7 of b g/r") {
  double before = 0, after = 0;
  run_contact(ball_on_ground(", velocity: [1, 0, 0], angular_velocity: [0, 10, 0]", "",
                             ", rolling_resistance: 1e-3, rolling_rate: 1e-3"),
              {1e-3, 0.9}, [&](const Session& session, const Motion&) {
                after = session.node("ball").v.x();
                if (session.time() < 0.4 + 1e-9) before = after;
              });
  CHECK_THAT((before - after) / 0.5, Catch::WithinRel(5. / 7 * 1e-3 * g / radius, 1e-3));
}
