// A thin disk that rolls on a plane without slip.
//
// m = 1 kg, radius a = 0.5 m, inertia m a^2/2 about its axis and m a^2/4 across it, g = 9.81 m/s^2. References: the
// equations of the rolling disk (J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972, ch. I),
// integrated by tests/references/rolling_disk.py; the steady circle and the wobble of an upright disk in closed form.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/second_order.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Eigen::Vector3d;

namespace {

constexpr double a = 0.5, g = 9.81;

/// @param centre,axis,spin,velocity  at the start; spin and velocity inertial
std::string disk(const Vector3d& centre, double lean, const Vector3d& body_rates, const Vector3d& velocity) {
  // The disk's axis is z of the node, which is turned about x by `lean`.
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  hub: {{position: [{:.17g}, {:.17g}, {:.17g}], rotation_vector: [{:.17g}, 0, 0],
        angular_velocity: [{:.17g}, {:.17g}, {:.17g}], velocity: [{:.17g}, {:.17g}, {:.17g}]}}
elements: {{disk: {{type: rigid_body, node: hub, mass: 1, inertia: [0.0625, 0.0625, 0.125]}}}}
joints:
  rim: {{type: wheel, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0], axis: [0, {:.17g}, {:.17g}], radius: 0.5}}
)yaml",
                     centre.x(), centre.y(), centre.z(), lean, body_rates.x(), body_rates.y(), body_rates.z(),
                     velocity.x(), velocity.y(), velocity.z(), -std::sin(lean), std::cos(lean));
}

/// Returns a disk on z = 0 whose contact is the origin: attitude R_x(lean), rates in its own axes.
std::string disk_at_origin(double lean, const Vector3d& body_rates) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(lean, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d axis = R.col(2), up = (Vector3d::UnitZ() - axis.z() * axis).normalized();
  return disk(a * up, lean, body_rates, (R * body_rates).cross(a * up));
}

double energy(const Session& session) {
  const auto e = session.energy();
  return e.kinetic + e.gravity;
}

}  // namespace

TEST_CASE("a leaning disk rolls as the equations of the rolling disk say, with order two") {
  const std::string text = disk_at_origin(110 * M_PI / 180, {0, 0, 4});
  const bielle::test::ReferenceTable exact("rolling_disk");
  Eigen::VectorXd expected(9);
  expected << exact.vector("centre"), exact.vector("axis"), exact.vector("force");
  const auto error = [&](double h) {
    Eigen::VectorXd left(9);
    move_to(text, h, 1, [&](const Session& session) {
      const auto& hub = session.node("hub");
      const std::vector<double> f = session.read("joints/rim/reaction_inertial");
      left << hub.x, hub.R.col(2), Vector3d(f[0], f[1], f[2]);
    });
    return Eigen::VectorXd(left - expected);
  };
  bielle::test::check_second_order(error, 0.005, 2, 0.15);
}

TEST_CASE("a rolling disk keeps its energy and touches the plane") {
  const std::string text = disk_at_origin(110 * M_PI / 180, {0, 0, 4});
  const double exact = bielle::test::ReferenceTable("rolling_disk")("energy");
  move(text, 0.0025, 3, [&](const Session& session) {
    CHECK(energy(session) == Approx(exact).epsilon(1e-4));
    const auto& hub = session.node("hub");
    const double c = hub.R(2, 2);
    CHECK(hub.x.z() == Approx(a * std::sqrt(1 - c * c)).epsilon(1e-10));
  });
}

TEST_CASE("a disk rolls in a steady circle") {
  // The centre runs on a circle of radius rho, the disk leans inwards by th: precession
  // P^2 = g tan(th)/(1.5 rho + 0.25 a sin(th)); contact force (m P^2 rho, m g).
  const double rho = 2, th = 20 * M_PI / 180;
  const double P = std::sqrt(g * std::tan(th) / (1.5 * rho + 0.25 * a * std::sin(th)));
  CHECK(P == Approx(1.083263531141).epsilon(1e-12));
  // In the frame of the disk (z its axis, x forward, leaning by 90 deg + th about x): no slip at the contact.
  const double lean = M_PI / 2 + th;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(lean, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d axis = R.col(2), up = (Vector3d::UnitZ() - axis.z() * axis).normalized();
  // The disk leans towards the centre of the circle.
  const double side = up.y() > 0 ? 1 : -1;
  const double speed = P * rho;
  for (const double turn : {1.0, -1.0}) {
    const Vector3d velocity(turn * side * speed, 0, 0);  // turn P e_z x (-side rho e_y)
    // omega = turn P e_z + s axis with omega x (a up) = velocity
    const Vector3d precession = turn * P * Vector3d::UnitZ();
    const double s = (velocity - precession.cross(a * up)).x() / axis.cross(a * up).x();
    const Vector3d omega = precession + s * axis;
    const Vector3d centre = a * up;
    const Vector3d middle = Vector3d(0, side * rho, 0) + Vector3d(centre.x(), centre.y(), 0);
    const std::string text = disk(centre, lean, R.transpose() * omega, velocity);
    move(text, 0.002, 2, [&](const Session& session) {
      const Vector3d x = session.node("hub").x;
      CHECK((x - middle).head<2>().norm() == Approx(rho).epsilon(1e-5));
      CHECK(x.z() == Approx(a * std::cos(th)).epsilon(1e-5));
      const std::vector<double> f = session.read("joints/rim/reaction_inertial");
      CHECK(std::hypot(f[0], f[1]) == Approx(P * P * rho).epsilon(1e-3));
      CHECK(f[2] == Approx(g).epsilon(1e-3));
    });
  }
}

TEST_CASE("an upright disk wobbles with the frequency of the linear theory") {
  // wobble frequency^2 = 0.8 (3 w^2 - g/a); at w = 6 the period is 0.747236 s.
  std::vector<double> zeros;
  double before = 0, time_before = 0;
  const std::string text = disk_at_origin(M_PI / 2, {1e-4, 0, 6});
  move(text, 0.001, 2, [&](const Session& session) {
    const double tilt = session.node("hub").R(2, 2);
    if (before < 0 && tilt >= 0)
      zeros.push_back(time_before + (session.time() - time_before) * before / (before - tilt));
    before = tilt;
    time_before = session.time();
  });
  REQUIRE(zeros.size() >= 2);
  CHECK((zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1) == Approx(0.747236153611).epsilon(1e-4));
}

TEST_CASE("a wheel that would have to be pulled down is said to lift off") {
  // A force larger than the weight drives a hub upwards.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {hub: {position: [0, 0, 0.5]}}
elements: {disk: {type: rigid_body, node: hub, mass: 1, inertia: [0.0625, 0.125, 0.0625]}}
joints: {rim: {type: wheel, nodes: [ground, hub], normal: [0, 0, 1], axis: [0, 1, 0], radius: 0.5}}
loads: {lift: {node: hub, force: [0, 0, "20*t"]}}
)yaml";
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<bielle::mechanism::Event> events;
  session.on_event([&](const bielle::mechanism::Event& event) { events.push_back(event); });
  bielle::mechanism::DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.01;
  session.dynamics(options).finish();
  REQUIRE(events.size() == 1);
  CHECK(events[0].time == Approx(9.81 / 20).epsilon(1e-6));
}

namespace {

/// Returns a wheel on z = 0 whose fork is drawn along x at 10 m/s, heading turned by `angle` from there.
std::string towed(double angle, const std::string& tyre, const std::string& more) {
  const double c = std::cos(angle), s = std::sin(angle), spin = 10 * c / a;
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  fork: {{position: [0, 0, 0.5], velocity: [10, 0, 0]}}
  hub: {{position: [0, 0, 0.5], velocity: [10, 0, 0], angular_velocity: [{0:.17g}, {1:.17g}, 0]}}
elements: {{disk: {{type: rigid_body, node: hub, mass: 1, inertia: [0.1, 0.1, 0.1]}},
           frame: {{type: rigid_body, node: fork, mass: 1, inertia: [0.1, 0.1, 0.1]}}}}
joints:
  tow: {{type: planar, nodes: [ground, fork], axis: [0, 1, 0], second_axis: [1, 0, 0], position: [0, 0, 0.5]}}
  axle: {{type: hinge, nodes: [fork, hub], axis: [{2:.17g}, {3:.17g}, 0]}}
  rim: {{type: wheel, nodes: [ground, hub], normal: [0, 0, 1], axis: [{2:.17g}, {3:.17g}, 0], radius: 0.5, slip: {{{4}}}}}
drives:
  pull: {{joint: tow, coordinate: x, speed: 10}}
  upright: {{joint: tow, angle: 0}}
)yaml",
                     -s * spin, c * spin, -s, c, tyre) +
         more;
}

}  // namespace

TEST_CASE("a tyre that runs at an angle has the lateral force of its slip") {
  // In free rolling, sigma_y = tan(angle) with the forward speed V cos(angle), smoothed by v_0.
  const double angle = 0.06, sigma = 10 * std::sin(angle) / std::hypot(10 * std::cos(angle), 0.1);
  move_to(towed(angle, "longitudinal: 80, lateral: 60", ""), 1e-3, 0.5, [&](const Session& session) {
    const std::vector<double> force = session.read("joints/rim/tyre_force"), slip = session.read("joints/rim/slip");
    CHECK(std::abs(slip[0]) < 1e-6);
    CHECK(std::abs(force[1]) == Approx(60 * sigma).epsilon(1e-6));
    // The tyre pushes the hub back to the direction of the wheel.
    CHECK(session.read("joints/tow/reaction_inertial")[1] == Approx(-60 * sigma * std::cos(angle)).epsilon(1e-4));
  });
  // Brush model: psi = 60 sigma/(3 mu N), N the weight of two kilograms.
  const double mu = 0.5, N = 2 * 9.81, psi = 60 * sigma / (3 * mu * N);
  REQUIRE(psi < 1);
  move_to(towed(angle, "longitudinal: 80, lateral: 60, friction: 0.5", ""), 1e-3, 0.5, [&](const Session& session) {
    CHECK(session.read("joints/rim/reaction_inertial")[2] == Approx(N).epsilon(1e-6));
    CHECK(std::abs(session.read("joints/rim/tyre_force")[1]) ==
          Approx(mu * N * (1 - std::pow(1 - psi, 3))).epsilon(1e-5));
  });
}

TEST_CASE("a braked tyre slides with its friction against its velocity") {
  // The axle is locked from the start: the whole contact slides at 10 m/s along x.
  std::string text = towed(0.06, "longitudinal: 80, lateral: 60, friction: 0.5",
                           "  brake: {joint: axle, torque: \"-200*axle.angle.rate\"}\n");
  move_to(text, 1e-3, 1, [&](const Session& session) {
    const std::vector<double> force = session.read("joints/rim/tyre_force");
    CHECK(std::hypot(force[0], force[1]) == Approx(0.5 * 2 * 9.81).epsilon(1e-3));
    CHECK(force[0] < -9);
  });
}

TEST_CASE("a disk that falls flat ends the run, which says so") {
  // Without spin it falls as a rod that stands on a line: theta'' = g a cos(theta)/(I/m + a^2), theta over the plane,
  // from 0.2 rad off the vertical; I/m = a^2/4. The time down to the plane by quadrature of the energy.
  const double k = 2 * g * a / (0.25 * a * a + a * a), begin = M_PI / 2 - 0.2;
  double time = 0;
  constexpr int parts = 20000;  // s^2 = sin(begin) - sin(theta): no singularity
  const double end = std::sqrt(std::sin(begin));
  for (int i = 0; i < parts; ++i) {
    const double s = (i + 0.5) * end / parts, sine = std::sin(begin) - s * s;
    time += end / parts * 2 / std::sqrt(k * (1 - sine * sine));
  }
  std::string says;
  try {
    move(disk({0, 0, a * std::cos(0.2)}, M_PI / 2 - 0.2, {0, 0, 0}, {0, 0, 0}), 0.002, 2, [](const Session&) {});
  } catch (const std::exception& error) {
    says = error.what();
  }
  CHECK_THAT(says, Catch::Contains("the wheel of joint 'rim' lies flat on its plane") &&
                       Catch::Contains(fmt::format("t = {:.2f}", std::floor(100 * time) / 100)) &&
                       !Catch::Contains("Newton"));
}
