// The radial spring of a tyre: weight, touch-down, roads, slopes.
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/temporary_folder.hpp"

namespace test_vertical_tyre {

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Eigen::Vector3d;

constexpr double g = 9.81, k = 2e4, m = 20;

/// Returns a wheel that does not turn, guided in the plane of x and z.
std::string block(const std::string& gravity, double height, const std::string& tyre, const std::string& more = "") {
  return fmt::format(R"yaml(
gravity: {}
nodes: {{hub: {{position: [0, 0, {:.17g}]}}}}
elements: {{disk: {{type: rigid_body, node: hub, mass: 20, inertia: [1, 1, 1]}}}}
joints:
  guide: {{type: planar, nodes: [ground, hub], axis: [0, 1, 0], second_axis: [1, 0, 0]{}}}
  tyre: {{type: tyre, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0], axis: [0, 1, 0], radius: 0.5, {}}}
drives: {{upright: {{joint: guide, angle: 0}}}}
)yaml",
                     gravity, height, more, tyre);
}

const std::string tread = "slip: {longitudinal: 4e3, lateral: 3e3, friction: 0.8, relaxation: 0.2}";

TEST_CASE("a tyre carries a weight with the deflection m g/k, and by its curve") {
  const bielle::test::TemporaryFolder folder;
  folder.file("force.csv", "0, 0\n0.005, 50\n0.02, 350\n");
  // The curve's second piece has the slope 2e4 N/m.
  const std::vector<std::pair<std::string, double>> tyres = {{"stiffness: 2e4", m * g / k},
                                                             {"curve: force.csv", 0.005 + (m * g - 50) / 2e4}};
  for (const auto& [keys, expected] : tyres) {
    const std::string text = block("[0, 0, -9.81]", 0.5, keys + ", " + tread, ", damping: {x: 1}, stiffness: {x: 1}");
    const auto file = bielle::mechanism::read_mechanism_file(folder.file("model.yaml", text));
    Session session(file.model);
    compute_statics(session, {});
    CHECK(session.read("joints/tyre/deflection")[0] == Approx(expected).epsilon(1e-9));
    CHECK(session.read("joints/tyre/normal_force")[0] == Approx(m * g).epsilon(1e-9));
    CHECK(session.node("hub").x.z() == Approx(0.5 - expected).epsilon(1e-12));
  }
}

TEST_CASE("a wheel falls, bounces and flies at the times of the closed form, with order two") {
  const double h = 0.1, w = std::sqrt(k / m), v = std::sqrt(2 * g * h);
  const double touch = v / g, leave = touch + 2 * (M_PI - std::atan2(v * w, g)) / w, top = leave + v / g;
  std::vector<double> times;
  const auto error = [&](double step) {
    const auto file =
        bielle::mechanism::read_mechanism_text(block("[0, 0, -9.81]", 0.6, "stiffness: 2e4"), "model.yaml");
    Session session(file.model);
    times.clear();
    session.on_event([&](const bielle::mechanism::Event& event) { times.push_back(event.time); });
    bielle::mechanism::DynamicsOptions options;
    options.duration = top + 0.05;
    options.stepping.size = step;
    session.dynamics(options).finish();
    REQUIRE(times.size() == 2);
    CHECK(times[0] == Approx(touch).epsilon(1e-6));
    Eigen::VectorXd left(2);
    left << times[1] - leave, session.node("hub").x.z() - (0.6 - 0.5 * g * 0.05 * 0.05);
    return left;
  };
  bielle::test::check_second_order(error, 4e-3, 2, 0.25, 0.2);
}

TEST_CASE("a damped tyre never pulls, and gives its energy to the damper") {
  double lowest = 0, last = 1, highest = 0;
  bool flew = false;
  move(block("[0, 0, -9.81]", 0.6, "stiffness: 2e4, damping: 300"), 1e-3, 2, [&](const Session& session) {
    const double N = session.read("joints/tyre/normal_force")[0], e = session.read("joints/tyre/deflection")[0];
    lowest = std::min(lowest, N);
    if (e <= 0) CHECK(N == 0);
    if (session.time() > 0.25 && e < 0) flew = true;
    if (session.time() > 0.3) highest = std::max(highest, session.node("hub").x.z());
    last = session.node("hub").x.z();
    CHECK(std::abs(session.balance()) < 2e-3 * m * g * 0.6);
  });
  CHECK(lowest == 0);
  CHECK(flew);
  CHECK(highest < 0.56);
  CHECK(last == Approx(0.5 - m * g / k).margin(2e-3));
}

TEST_CASE("a braked wheel stands on a slope by the stiffness of its tread, and does not creep") {
  const double slope = 0.3;  // below the friction
  const double W = m * g * std::sin(slope), K = 4e3 / 0.2;
  std::vector<double> places;
  move(block(fmt::format("[{:.17g}, 0, {:.17g}]", g * std::sin(slope), -g * std::cos(slope)),
             0.5 - m * g * std::cos(slope) / k, "stiffness: 2e4, damping: 200, " + tread, ", damping: {x: 400}"),
       2e-3, 40, [&](const Session& session) {
         if (session.time() > 5) places.push_back(session.node("hub").x.x());
         if (session.time() > 39.99) CHECK(session.read("joints/tyre/tyre_force")[0] == Approx(-W).epsilon(1e-6));
       });
  REQUIRE(places.size() > 10000);
  CHECK(std::abs(places.back() - places.front()) < 1e-9);
  // The sudden start deflects the tread up to twice as far, and makes it slip by a part of this.
  CHECK(places.back() > 0.9999 * W / K);
  CHECK(places.back() < 2 * W / K);
}

TEST_CASE("a braked wheel slides down a slope that is too steep with the acceleration of Coulomb's law") {
  const double slope = 0.9, a = g * (std::sin(slope) - 0.8 * std::cos(slope));
  double before = 0;
  move(block(fmt::format("[{:.17g}, 0, {:.17g}]", g * std::sin(slope), -g * std::cos(slope)),
             0.5 - m * g * std::cos(slope) / k, "stiffness: 2e4, " + tread),
       1e-3, 1, [&](const Session& session) {
         if (std::abs(session.time() - 0.5) < 1e-6) before = session.node("hub").v.x();
         if (std::abs(session.time() - 1) < 1e-6)
           CHECK((session.node("hub").v.x() - before) / 0.5 == Approx(a).epsilon(1e-5));
       });
  CHECK(before > 0);
}

TEST_CASE("a wheel that is lifted off loses the force along the road") {
  // A force pushes the wheel along x while it stands, and then lifts it.
  move(block("[0, 0, -9.81]", 0.5 - m * g / k, "stiffness: 2e4, damping: 100, " + tread) +
           "loads: {push: {node: hub, force: [60, 0, \"if(t < 1, 0, 400*(t - 1))\"]}}\n",
       1e-3, 2, [&](const Session& session) {
         const double N = session.read("joints/tyre/normal_force")[0];
         const std::vector<double> force = session.read("joints/tyre/tyre_force");
         CHECK(std::abs(force[0]) <= 0.8 * N + 5);
         if (session.time() > 1.6) CHECK(force[0] == 0);
       });
}

TEST_CASE("a tyre on a road has the distance to its nearest point and the normal there") {
  const bielle::test::TemporaryFolder folder;
  const auto height = [](double x) { return 0.12 * std::sin(2 * x); };
  std::string table;
  for (int i = -100; i <= 100; ++i) table += fmt::format("{:.17g}, {:.17g}\n", 0.05 * i, height(0.05 * i));
  folder.file("road.csv", table);
  for (const double x : {-1.3, -0.4, 0.1, 0.7, 1.9, 2.4}) {
    CAPTURE(x);
    const double z = height(x) + 0.45;
    double nearest = 1e9, at = 0;
    for (double s = x - 0.6; s < x + 0.6; s += 1e-6)
      if (const double d = std::hypot(x - s, z - height(s)); d < nearest) {
        nearest = d;
        at = s;
      }
    const auto file = bielle::mechanism::read_mechanism_file(folder.file("model.yaml", fmt::format(R"yaml(
nodes: {{hub: {{position: [{:.17g}, 0, {:.17g}], fixed: true}}}}
joints:
  tyre: {{type: tyre, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0], axis: [0, 1, 0], radius: 0.5,
          stiffness: 2e4, road: {{table: road.csv}}}}
)yaml",
                                                                                                   x, z)));
    Session session(file.model);
    CHECK(session.read("joints/tyre/deflection")[0] == Approx(0.5 - nearest).epsilon(1e-5));
    const std::vector<double> f = session.read("joints/tyre/reaction_inertial");
    const Vector3d n = Vector3d(x - at, 0, z - height(at)).normalized();
    CHECK((Vector3d(f[0], f[1], f[2]) - 2e4 * (0.5 - nearest) * n).norm() < 1e-4 * 2e4 * (0.5 - nearest));
  }
}

TEST_CASE("a straight sloping road is a plane that is turned") {
  const bielle::test::TemporaryFolder folder;
  folder.file("road.csv", "-1, -0.2\n1, 0.2\n");
  const auto text = [](const std::string& road) {
    return "gravity: [1, 0.3, -9.81]\n"
           "nodes: {hub: {position: [0, 0, 0.49], angular_velocity: [0, 4, 0.3], velocity: [2, 0, 0]}}\n"
           "elements: {disk: {type: rigid_body, node: hub, mass: 20, inertia: [1, 1, 1]}}\n"
           "joints: {tyre: {type: tyre, nodes: [ground, hub], position: [0, 0, 0], axis: [0, 1, 0], radius: 0.5, "
           "stiffness: 2e4, damping: 100, rolling_resistance: 0.02, " +
           tread + ", " + road + "}}\n";
  };
  std::vector<Vector3d> places;
  const std::string normal =
      fmt::format("normal: [{:.17g}, 0, {:.17g}]", -0.2 / std::hypot(1, 0.2), 1 / std::hypot(1, 0.2));
  for (const std::string& road : {std::string("normal: [0, 0, 1], road: {table: road.csv}"), normal}) {
    const auto file = bielle::mechanism::read_mechanism_file(folder.file("model.yaml", text(road)));
    Session session(file.model);
    bielle::mechanism::DynamicsOptions options;
    options.duration = 0.6;
    options.stepping.size = 2e-3;
    session.dynamics(options).finish();
    places.push_back(session.node("hub").x);
  }
  CHECK((places[0] - places[1]).norm() < 1e-8);
  CHECK(places[0].norm() > 0.5);
}

TEST_CASE("a wheel that runs over a bump keeps its account of energy and flies behind it") {
  const bielle::test::TemporaryFolder folder;
  std::string table;
  for (int i = 0; i <= 80; ++i) {
    const double x = 0.05 * i, s = std::clamp(x - 1, 0.0, 1.0);
    table += fmt::format("{:.17g}, {:.17g}\n", x, 0.06 * std::pow(std::sin(M_PI * s), 2));
  }
  folder.file("bump.csv", table);
  const std::string text =
      "gravity: [0, 0, -9.81]\n"
      "nodes: {hub: {position: [0, 0, 0.49019], angular_velocity: [0, 16, 0], velocity: [8, 0, 0]}}\n"
      "elements: {disk: {type: rigid_body, node: hub, mass: 20, inertia: [1, 2, 1]}}\n"
      "joints:\n"
      "  guide: {type: planar, nodes: [ground, hub], axis: [0, 1, 0], second_axis: [1, 0, 0]}\n"
      "  tyre: {type: tyre, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0], axis: [0, 1, 0], radius: "
      "0.5, "
      "stiffness: 2e4, damping: 100, rolling_resistance: 0.02, road: {table: bump.csv}, " +
      tread + "}\n";
  const auto file = bielle::mechanism::read_mechanism_file(folder.file("model.yaml", text));
  Session session(file.model);
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.8;
  options.stepping.size = 5e-4;
  bielle::mechanism::Motion motion = session.dynamics(options);
  bool flew = false;
  double dissipated = 0;
  while (motion.step()) {
    flew |= session.read("joints/tyre/deflection")[0] < -0.005;
    const double now = motion.energy().dissipation;
    CHECK(now >= dissipated - 1e-9);
    dissipated = now;
  }
  CHECK(flew);
  CHECK(dissipated > 1);
  CHECK(std::abs(session.balance()) < 0.01 * dissipated);
}

}  // namespace test_vertical_tyre
