// Cams: an eccentric circle has closed forms for flat and roller followers.
//
// A circle of radius R whose middle is e away from the camshaft, at the angle theta:
//     flat face:  y = R + e sin(theta),   roller of radius r:  y = e sin(theta) + sqrt((R + r)^2 - e^2 cos(theta)^2).
// The torque is F dy/dtheta with the force F = m (y'' + g) on the follower's mass.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::mechanism::Session;
using bielle::test::move;

namespace test_cams {
namespace {

constexpr double R = 0.03, e = 0.01, r = 0.008, speed = 20, m = 0.5, g = 9.81;

std::string cam(const bielle::test::TemporaryFolder& folder, double start, const std::string& contact,
                double turns = 1) {
  const std::string path = folder.path() + "/circle.csv";
  std::ofstream out(path);
  constexpr int n = 720;  // the spline's curvature is right to (2 pi/n)^2/12 = 6e-6
  for (int k = 0; k < n; ++k) {
    // The distance from the shaft to the circle along the direction phi.
    const double phi = 2 * M_PI * k / n;
    out << fmt::format("{:.17g}, {:.17g}\n", phi,
                       e * std::cos(phi) + std::sqrt(R * R - std::pow(e * std::sin(phi), 2)));
  }
  return fmt::format(R"yaml(
gravity: [0, -9.81, 0]
nodes: {{shaft: {{}}, tappet: {{position: [0, {:.17g}, 0]}}}}
elements:
  b: {{type: rigid_body, node: shaft, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  t: {{type: rigid_body, node: tappet, mass: 0.5, inertia: [1e-4, 1e-4, 1e-4]}}
joints:
  contact: {{type: cam, joints: [camshaft, guide], profile: "{}", {}}}
  camshaft: {{type: hinge, nodes: [ground, shaft], axis: [0, 0, 1], second_axis: [1, 0, 0]}}
  guide: {{type: prismatic, nodes: [ground, tappet], axis: [0, 1, 0]}}
drives: {{motor: {{joint: camshaft, angle: "{}*t"}}}}
)yaml",
                     start, path, contact, speed * turns);
}

}  // namespace

TEST_CASE("a flat follower on an eccentric circle moves harmonically and takes its torque") {
  const bielle::test::TemporaryFolder folder;
  const std::string text = cam(folder, R, "follower: flat, normal: [0, 1, 0]");
  move(text, 1e-3, 0.7, [](const Session& session) {
    const double theta = speed * session.time();
    CHECK(session.node("tappet").x.y() == Approx(R + e * std::sin(theta)).margin(2e-9));
    // The scheme's own error of accelerations is slightly more than (h w)^2/12 of e w^2 = 4 m/s^2.
    const double force = m * (g - e * speed * speed * std::sin(theta));
    CHECK(session.read("joints/contact/reaction_inertial")[1] == Approx(force).margin(2e-3));
    CHECK(session.read("joints/camshaft/drive_force")[0] == Approx(force * e * std::cos(theta)).margin(2e-5));
  });
}

TEST_CASE("a roller on an eccentric circle moves as its closed form, over several turns") {
  const bielle::test::TemporaryFolder folder;
  const std::string text =
      cam(folder, std::sqrt(std::pow(R + r, 2) - e * e), fmt::format("follower: roller, radius: {}", r));
  move(text, 1e-3, 0.7, [](const Session& session) {
    const double theta = speed * session.time(), c = e * std::cos(theta);
    const double y = e * std::sin(theta) + std::sqrt((R + r) * (R + r) - c * c);
    CHECK(session.node("tappet").x.y() == Approx(y).margin(1e-8));
  });
}

TEST_CASE("a cam that turns too fast is said to lift off") {
  // At twice the speed, 16 m/s^2 downwards are required at the top, more than g: at e w^2 sin(theta) = g.
  const bielle::test::TemporaryFolder folder;
  const std::string text = cam(folder, R, "follower: flat, normal: [0, 1, 0]", 2);
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<bielle::mechanism::Event> events;
  session.on_event([&](const bielle::mechanism::Event& event) { events.push_back(event); });
  bielle::mechanism::DynamicsOptions options;
  options.duration = 2 * M_PI / (2 * speed);
  options.stepping.size = 2e-4;
  session.dynamics(options).finish();
  REQUIRE(events.size() == 1);
  CHECK(events[0].time == Approx(std::asin(g / (e * 4 * speed * speed)) / (2 * speed)).epsilon(2e-3));
}

TEST_CASE("a flat follower of a shaft that speeds up lifts off once in a turn, at a time of order 2") {
  // N = m (g + e (theta'' cos(theta) - theta'^2 sin(theta))), theta = w t + a t^2/2, falls through zero.
  const bielle::test::TemporaryFolder folder;
  const double w = 25, a = 60;
  std::string text = cam(folder, R, "follower: flat, normal: [0, 1, 0]");
  text.replace(text.find("\"20*t\""), 6, "\"25*t + 30*t^2\"");
  const auto push = [&](double t) {
    const double theta = w * t + a * t * t / 2, rate = w + a * t;
    return g + e * (a * std::cos(theta) - rate * rate * std::sin(theta));
  };
  double low = 0.2, high = 0.28;  // the second turn
  for (double t = 0; t < low; t += 1e-4) REQUIRE(push(t) > 0);
  double first = low;
  while (push(first) > 0) first += 1e-4;
  REQUIRE(first < high);
  for (low = first - 1e-4, high = first; high - low > 1e-14;) {
    const double middle = 0.5 * (low + high);
    (push(middle) > 0 ? low : high) = middle;
  }
  const double until = high + 0.02;  // in the same turn
  for (const double h : {2e-3, 1e-3, 5e-4, 2e-4}) {
    Session session(bielle::mechanism::read_mechanism_text(text, "model.yaml").model);
    std::vector<double> times;
    session.on_event([&](const bielle::mechanism::Event& event) { times.push_back(event.time); });
    bielle::mechanism::DynamicsOptions options;
    options.duration = h * std::ceil(until / h);
    options.stepping.size = h;
    bielle::mechanism::Motion motion = session.dynamics(options);
    REQUIRE(motion.finish());
    INFO("h = " << h);
    REQUIRE(times.size() == 1);
    // A chord of N over a step deviates by N'' h^2/8 at most, the scheme's accelerations by about (theta' h)^2/12 or
    // less (the spline adds 6e-6): together by no more than (theta' h)^2/4 of e theta'^2, which falls by -N'.
    const double rate = w + a * high, slope = (push(high - 1e-6) - push(high + 1e-6)) / 2e-6;
    CHECK(times[0] == Approx(high).margin(std::pow(rate * h, 2) / 4 * e * rate * rate / slope).epsilon(0));
  }
}

TEST_CASE("contours that a follower cannot follow are refused") {
  const bielle::test::TemporaryFolder folder;
  const auto run = [&](const std::string& contour, const std::string& contact) {
    std::string text = cam(folder, R, contact);
    std::ofstream(folder.path() + "/circle.csv") << contour;
    move(text, 1e-3, 0.01, [](const Session&) {});
  };
  std::string hollow;
  for (int k = 0; k < 72; ++k)
    hollow += fmt::format("{}, {}\n", 2 * M_PI * k / 72, 0.03 + 0.005 * std::cos(6 * M_PI * k / 36));
  CHECK_THROWS_WITH(run(hollow, "follower: flat, normal: [0, 1, 0]"), Catch::Contains("hollow"));
  CHECK_THROWS_WITH(run(hollow, "follower: roller, radius: 0.05"), Catch::Contains("does not fit into the hollow"));
  CHECK_THROWS_WITH(run("0, 1\n1, 1\n7, 1\n", "follower: roller, radius: 0"), Catch::Contains("less than a turn"));
  CHECK_THROWS_WITH(run("0, 1\n1, -1\n3, 1\n", "follower: roller, radius: 0"), Catch::Contains("greater than 0"));
  CHECK_THROWS_WITH(run("0, 1\n1, 1\n3, 1\n", "follower: flat, normal: [0, 1, 1]"), Catch::Contains("right angles"));
}

// The guide has no friction, so that the push of the cam has the vertical component V = m (y'' + g). The torque follows
// from the power of V and of friction, and for the roller also from the force on the cam.

TEST_CASE("a flat follower rubs on its cam by the push times the way along the contour") {
  // The contour slides along the face at w (R + e sin(theta)) against the friction mu V.
  const double mu = 0.3;
  const bielle::test::TemporaryFolder folder;
  const std::string text = cam(
      folder, R, fmt::format("follower: flat, normal: [0, 1, 0], friction: {{coefficient: {}, velocity: 1e-6}}", mu));
  double way = 0, before = 0;
  move(text, 1e-3, 0.7, [&](const Session& session) {
    const double t = session.time(), theta = speed * t;
    const double push = m * (g - e * speed * speed * std::sin(theta)), along = R + e * std::sin(theta);
    CHECK(session.read("joints/contact/normal_force")[1] == Approx(push).margin(2e-3));
    CHECK(session.read("joints/contact/friction")[1] == Approx(mu * push).margin(1e-3));
    if (t > 0)
      CHECK(session.read("joints/camshaft/drive_force")[0] ==
            Approx(push * (e * std::cos(theta) + mu * along)).margin(1e-4));
    // The coordinates are those of the follower relative to the cam, counted over turns.
    const std::vector<double> c = session.read("joints/contact/coordinate");
    CHECK(c[0] == Approx(-theta).margin(1e-9));
    way = R * theta + e * (1 - std::cos(theta));  // integral of H
    CHECK(c[1] == Approx(-way).margin(1e-7));
    CHECK(std::abs(c[1] - before) < 1e-3);  // without jumps by a turn
    before = c[1];
  });
  CHECK(way > 2 * 2 * M_PI * R);
}

TEST_CASE("a roller turns on its pin, and is dragged by what rubs there") {
  const double mu = 0.4, pin = 0.005;
  const bielle::test::TemporaryFolder folder;
  const double reach = R + r;
  const std::string text = cam(folder, std::sqrt(reach * reach - e * e),
                               fmt::format("follower: roller, radius: {}, friction: {{coefficient: {}, radius: {}, "
                                           "velocity: 1e-6}}",
                                           r, mu, pin));
  move(text, 1e-3, 0.7, [&](const Session& session) {
    if (session.time() == 0) return;  // no surface slides yet, because the drive's speed begins here
    const double theta = speed * session.time(), s = std::sin(theta), c = std::cos(theta);
    const double root = std::sqrt(reach * reach - e * e * c * c);
    const double y1 = e * c + e * e * s * c / root;
    const double y2 = -e * s + e * e * ((c * c - s * s) / root - e * e * s * s * c * c / std::pow(root, 3));
    const double V = m * (y2 * speed * speed + g);
    // The normal points from the circle's middle to the roller's. The force of the cam on the roller is turned from it
    // by beta in the direction in which the contour moves: the cam turns anticlockwise, its surface to -x. sin(beta) =
    // mu pin/r.
    const double beta = std::asin(mu * pin / r), alpha = std::atan2(root, -e * c) + beta;
    const double force = V / std::sin(alpha);
    CHECK(session.read("joints/contact/normal_force")[1] == Approx(force).margin(3e-3));
    // The moment is that at the place of contact about the camshaft.
    const double n_x = -e * c / reach, n_y = root / reach;
    const double x = e * c + R * n_x, y = e * s + R * n_y;
    const double torque = force * (x * std::sin(alpha) - y * std::cos(alpha));
    CHECK(session.read("joints/camshaft/drive_force")[0] == Approx(torque).margin(2e-4));
    // The roller turns clockwise. Its rate relative to the pin is R/r times that of the cam, plus the rate due to the
    // motion of its centre.
    const double n_rate = -e * s * speed / root;  // rate of the normal: cos(angle) = -e c/reach
    const double spin = (reach * (n_rate - speed) + speed * r) / r;
    CHECK(V * y1 * speed + mu * pin * force * std::abs(spin) == Approx(torque * speed).epsilon(1e-9));
    const std::vector<double> rate = session.read("joints/contact/rate");
    // The scheme's own error of velocities is about (h w)^2/12 of e w/r.
    CHECK(rate[0] / r - rate[1] == Approx(spin).margin(1e-3));
  });
}

TEST_CASE("a knife edge rubs on the contour itself") {
  // A circle about the shaft's axis would cause friction only; on the eccentric one the force is inclined by mu from
  // the normal.
  const double mu = 0.2;
  const bielle::test::TemporaryFolder folder;
  const std::string text =
      cam(folder, std::sqrt(R * R - e * e),
          fmt::format("follower: roller, radius: 0, friction: {{coefficient: {}, velocity: 1e-6}}", mu));
  move(text, 1e-3, 0.7, [&](const Session& session) {
    if (session.time() == 0) return;
    const double theta = speed * session.time(), s = std::sin(theta), c = std::cos(theta);
    const double root = std::sqrt(R * R - e * e * c * c);
    const double y2 = -e * s + e * e * ((c * c - s * s) / root - e * e * s * s * c * c / std::pow(root, 3));
    const double alpha = std::atan2(root, -e * c) + std::atan(mu);
    const double force = m * (y2 * speed * speed + g) / std::sin(alpha);
    CHECK(session.read("joints/contact/normal_force")[0] == Approx(force * std::cos(std::atan(mu))).margin(3e-3));
    const double torque = -force * (e * s + root) * std::cos(alpha);  // acts at x = 0
    CHECK(session.read("joints/camshaft/drive_force")[0] == Approx(torque).margin(2e-4));
  });
}

}  // namespace test_cams
