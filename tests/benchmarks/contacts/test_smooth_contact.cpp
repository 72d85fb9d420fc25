// Accuracy: order 2 of the steps on a contact that stays closed, and Painleve's rod against its own equations.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

TEST_CASE("steps are of second order on a contact that stays closed") {
  // A ball on Hertz's spring starts 20 % away from equilibrium.
  const double rest = std::pow(9.81 / 1e4, 1 / 1.5), T = 2 * M_PI / std::sqrt(1.5 * 9.81 / rest);
  const auto rate = [](const Eigen::Vector2d& z) -> Eigen::Vector2d {
    const double p = 0.1 - z[0];
    return {z[1], -9.81 + 1e4 * std::pow(p, 1.5) * (1 - 0.3 * z[1])};
  };
  Eigen::Vector2d reference(0.1 - 1.2 * rest, 0);
  advance_by_runge_kutta(reference, 3 * T, 30000, rate);
  double errors[3];
  for (int k = 0; k < 3; ++k) {
    const std::string text =
        contact_model({{"ball", fmt::format("position: [0, 0, {:.17g}]", 0.1 - 1.2 * rest)}},
                      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], "
                      "stiffness: 1e4, damping: 0.3}\n",
                      "[0, 0, -9.81]");
    run_contact(text, {T / (50 << k), 3 * T, 0, 0.9}, [&](const Session& session, const Motion&) {
      const NodeState& ball = session.node("ball");
      errors[k] = std::hypot((ball.x.z() - reference[0]) / rest, (ball.v.z() - reference[1]) * T / rest);
    });
  }
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.1));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.1));
}

TEST_CASE("Painleve's rod runs through with compliant contact, as its own equations say") {
  // A slender rod slides on its lower end. With rigid contact the normal force would be (..)/A,
  //   A = 1 + 3 cos(a) (cos(a) - mu sin(a))   (times 1/m),
  // negative at tan(a) = 2 for mu > 4/3: no motion fits (F. Genot, B. Brogliato, Eur. J. Mech. A/Solids 18 (1999)
  // 653-677). With compliance, the end digs in until it stops sliding, and is thrown off.
  constexpr double mu = 2, half = 0.5, r = 0.01, k = 1e7, d = 0.05, v_0 = 0.01, g = 9.81, J = 1. / 12;
  const double a = std::atan(2.0);
  REQUIRE(1 + 3 * std::cos(a) * (std::cos(a) - mu * std::sin(a)) < 0);
  // x, z, angle of the rod's direction upwards from the end about -y, and their rates. The end e = middle - half (cos,
  // sin), a ball of radius r.
  using Six = Eigen::Matrix<double, 6, 1>;
  const auto force = [&](const Six& z) -> std::array<double, 3> {
    const double c = std::cos(z[2]), s = std::sin(z[2]);
    const double p = r - (z[1] - half * s);
    if (p <= 0) return {0, 0, p};
    const double arm_z = -half * s - r + 0.5 * p, arm_x = -half * c;  // place of contact from the middle
    const double vx = z[3] - z[5] * arm_z, vz = z[4] + z[5] * arm_x;
    const double N = k * std::pow(p, 1.5) * std::max(0.0, 1 - d * vz);
    return {-N * mu * std::tanh(vx / v_0), N, p};
  };
  const auto rate = [&](const Six& z) {
    const auto [F, N, p] = force(z);
    const double arm_z = -half * std::sin(z[2]) - r + 0.5 * std::max(p, 0.0), arm_x = -half * std::cos(z[2]);
    Six change;
    change << z.tail<3>(), F, N - g, (arm_x * N - arm_z * F) / J;
    return change;
  };
  Six z;
  // The rod leans towards +x from its lower end, which slides along -x.
  z << 0, half * std::sin(a) + r, a, -1, 0, 0;
  const Six start = z;
  const std::string text = contact_model(
      {{"rod",
        fmt::format("position: [0, 0, {:.17g}], rotation_vector: [0, {:.17g}, 0], velocity: [{}, 0, 0]", start[1],
                    M_PI / 2 - a, start[3]),
        1,
        {J, J, 1e-4}}},
      fmt::format(
          "  it: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: rod, capsule: [{}, {}]}}], "
          "stiffness: {}, damping: {}, friction: {{coefficient: {}, velocity: {}}}}}\n",
          r, 2 * half, k, d, mu, v_0),
      "[0, 0, -9.81]");
  double time = 0, worst = 0, largest = 0, energy = 1e300, grown = 0;
  run_contact(text, {5e-6, 0.03}, [&](const Session& session, const Motion& motion) {
    if (session.time() > time) advance_by_runge_kutta(z, session.time() - time, 4, rate);
    time = session.time();
    const NodeState& rod = session.node("rod");
    worst = std::max({worst, std::abs(rod.v.x() - z[3]), std::abs(rod.v.z() - z[4]), std::abs(-rod.Omega.y() - z[5])});
    largest = std::max(largest, session.read("contacts/it/force")[2]);
    const double now = motion.energy().kinetic + motion.energy().elastic + motion.energy().gravity;
    grown = std::max(grown, now - energy);
    energy = std::min(energy, now);
  });
  INFO("largest normal force " << largest);
  CHECK(largest > 10 * g);  // it jams
  CHECK(worst < 5e-3);
  CHECK(grown < 1e-5);
}
