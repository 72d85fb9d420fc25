// Inverse dynamics of machines whose parts bend: closed forms of a slender arm, the work of the drives, and the limit
// of rigid parts.
#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/benchmarks/driven/delta_robot.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace {

/// The steel strip of 1 m is driven about z at its root.
constexpr double length = 1, width = 0.02, thickness = 0.01, young = 210e9, density = 7850;
constexpr double per_length = density * width * thickness;
std::string strip(const std::string& angle, double stiffer = 1) {
  return fmt::format(
      "nodes: {{root: {{}}, tip: {{position: [1, 0, 0]}}}}\n"
      "elements: {{strip: {{type: beam, nodes: [root, tip], elements: 16, orientation: [0, 0, 1], section: "
      "{{rectangle: "
      "[0.02, 0.01], young: {}, poisson: 0.3, density: 7850}}}}}}\n"
      "joints: {{shaft: {{type: hinge, nodes: [ground, root], axis: [0, 0, 1]}}}}\n"
      "drives: {{motor: {{joint: shaft, angle: \"{}\"}}}}\n",
      young * stiffer, angle);
}

}  // namespace

TEST_CASE("the strip lags behind its drive by the deflection under its own inertia") {
  // At rest with the angular acceleration a, the load per length is -mu a x: w(L) = -(11/120) mu a L^5/EI, and the
  // torque mu a L^3/3 to second order in w. phi = A (1 - cos(w t)) starts so.
  const double A = 0.02, w = 3, a = A * w * w;
  const MechanismFile file = read_mechanism_text(strip(fmt::format("{}*(1 - cos({}*t))", A, w)), "model.yaml");
  Session session(file.model);
  const KinematicsReport report =
      compute_kinematics(session, {.duration = 2 * M_PI / w, .step = 2 * M_PI / w / 40, .elastic = true});
  CHECK(report.elastic);
  const double EI = young * width * std::pow(thickness, 3) / 12;
  const double deflection = -11.0 / 120 * per_length * a * std::pow(length, 5) / EI;
  // 16 elements of linear rotations have an error of (1/16)^2/2 of the curvature's variation; shear adds (t/L)^2.
  CHECK(session.node("tip").x[1] == Approx(deflection).epsilon(3e-3));
  CHECK(session.read("joints/shaft/drive_force")[0] == Approx(per_length * a * std::pow(length, 3) / 3).epsilon(1e-3));
  // (w/w_1)^2 with the first natural frequency 3.516 sqrt(EI/mu L^4) is the effect of the deformation's own
  // acceleration.
  const double first = 3.516 * std::sqrt(EI / per_length);
  CHECK(report.left_out > 0);
  CHECK(report.left_out < 2 * std::pow(w / first, 2));
}

TEST_CASE("inverse dynamics of a turning strip stretches it by the centrifugal force") {
  // E u'' = -rho w^2 (x + u): u(L) = tan(k L)/k - L with k^2 = rho w^2/E, and no torque. At 500 rad/s, ten times the
  // slowest mode, the forces at the undeformed radius would make u(L) = k^2 L^3/3, 0.4 % less.
  for (const double w : {20, 500}) {
    CAPTURE(w);
    const MechanismFile file = read_mechanism_text(strip(fmt::format("{}*t", w)), "model.yaml");
    Session session(file.model);
    compute_kinematics(session, {.duration = 2 / w, .step = 0.2 / w, .elastic = true});
    const double k = w * std::sqrt(density / young);
    // Deformations settle to 1e-9; elements err by (k L/16)^2/12.
    CHECK(session.node("tip").x.norm() - length ==
          Approx(std::tan(k * length) / k - length).epsilon(1e-5).margin(2e-9));
    CHECK(std::abs(session.read("joints/shaft/drive_force")[0]) < 1e-6 * per_length * w * w);
  }
}

TEST_CASE("a mass on a radial spring turns at the radius to which the centrifugal force takes it") {
  // k e = m w^2 (r + e): e = m w^2 r/(k - m w^2), the node's speed is w (r + e), and nothing needs a torque.
  struct Case {
    double speed, stiffness;
  };
  for (const auto& [w, k] : {Case{10, 1e4}, Case{40, 1e4}, Case{0, 1e4}, Case{10, 1e9}}) {
    CAPTURE(w, k);
    const double m = 1, r = 0.5, e = m * w * w * r / (k - m * w * w);
    const MechanismFile file = read_mechanism_text(
        fmt::format("nodes:\n  r: {{motion: {{x: 0, y: 0, z: 0, rx: 0, ry: 0, rz: \"{}*t\"}}}}\n"
                    "  m: {{position: [0.5, 0, 0]}}\n"
                    "elements: {{m: {{type: rigid_body, node: m, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}}}\n"
                    "joints: {{s: {{type: prismatic, nodes: [r, m], position: [0.5, 0, 0], axis: [1, 0, 0], "
                    "stiffness: {}}}}}\n",
                    w, k),
        "model.yaml");
    Session session(file.model);
    session.on_step([&](Session& at) {
      CHECK(at.read("joints/s/coordinate")[0] == Approx(e).epsilon(1e-7).margin(1e-12));
      CHECK(at.node("m").v.norm() == Approx(w * (r + e)).epsilon(1e-7).margin(1e-12));
      CHECK(at.node("m").a.norm() == Approx(w * w * (r + e)).epsilon(1e-7).margin(1e-12));
      CHECK(std::abs(at.read("supports/r/reaction")[5]) < 1e-6 * m * w * w * r * r + 1e-12);
    });
    const KinematicsReport report = compute_kinematics(session, {.duration = 0.4, .step = 0.01, .elastic = true});
    CHECK(report.left_out < 1e-4);  // constant in the turning axes
    CHECK(std::abs(report.balance) < 1e-9 * (1 + m * w * w * r * r));
  }
}

TEST_CASE("a mass on a radial spring of a shaft that starts up is pressed by what Coriolis leaves of its deformation") {
  // phi = a t^2/2. Without the deformation's own rates, k e = m w^2 (r + e), and the torque is m (r + e)^2 a, w = a t,
  // at the radius of the mass.
  const double m = 2, k = 5e3, r = 0.5, a = 8;
  const MechanismFile file = read_mechanism_text(
      fmt::format("nodes:\n  r: {{motion: {{x: 0, y: 0, z: 0, rx: 0, ry: 0, rz: \"0.5*{}*t^2\"}}}}\n"
                  "  m: {{position: [0.5, 0, 0]}}\n"
                  "elements: {{m: {{type: rigid_body, node: m, mass: {}, inertia: [1e-12, 1e-12, 1e-12]}}}}\n"
                  "joints: {{s: {{type: prismatic, nodes: [r, m], position: [0.5, 0, 0], axis: [1, 0, 0], "
                  "stiffness: {}}}}}\n",
                  a, m, k),
      "model.yaml");
  Session session(file.model);
  session.on_step([&](Session& at) {
    const double w = a * at.time(), radius = r + m * w * w * r / (k - m * w * w);
    CHECK(at.node("m").x.norm() == Approx(radius).epsilon(1e-7));
    CHECK(at.read("supports/r/reaction")[5] == Approx(m * radius * radius * a).epsilon(1e-6));
  });
  compute_kinematics(session, {.duration = 2, .step = 0.05, .elastic = true});
}

TEST_CASE("the drives of a delta robot with elastic arms do the work that its energies take") {
  using bielle::test::delta_robot;
  const auto run = [](double stiffer, double& missing, double& exchanged) {
    const MechanismFile file = read_mechanism_text(delta_robot(stiffer), "model.yaml");
    Session session(file.model);
    std::vector<double> torques;
    missing = exchanged = 0;
    session.on_step([&](Session& at) {
      torques.push_back(at.read("joints/motor_1/drive_force")[0]);
      missing = std::max(missing, std::abs(at.balance()));
      exchanged = std::max(exchanged, at.energy().kinetic);
    });
    const KinematicsReport report = compute_kinematics(session, {.duration = 0.35, .step = 2.5e-3, .elastic = true});
    CHECK(report.indifferent.size() == 6);  // the rods' spins
    CHECK(report.left_out < 0.01 / stiffer);
    return torques;
  };
  double missing = 0, missing_stiff = 0, exchanged = 0;
  const std::vector<double> elastic = run(1, missing, exchanged), stiff = run(1e4, missing_stiff, exchanged);
  CHECK(exchanged > 1);
  // The trapezoidal rule has an error of (h w)^2/12, or 5e-4 of the exchanged energy; with elastic arms the neglected
  // terms are added.
  CHECK(missing_stiff < 1e-3 * exchanged);
  CHECK(missing < 2e-3 * exchanged);
  REQUIRE(elastic.size() == stiff.size());
  for (std::size_t k = 0; k < stiff.size(); ++k) CHECK(elastic[k] == Approx(stiff[k]).margin(0.01));
  // The torque at rest follows from statics: the sum over the loads of one arm, see delta_robot.hpp.
  CHECK(stiff.front() == Approx(bielle::test::delta_torque_at_rest()).epsilon(1e-6));
}

TEST_CASE("inverse dynamics refuses what nothing drives, holds or balances") {
  std::string hanging = strip("0.1*t");
  hanging = "gravity: [0, -9.81, 0]\n" + hanging.substr(0, hanging.find("drives"));
  const MechanismFile loose = read_mechanism_text(hanging, "model.yaml");
  Session session(loose.model);
  CHECK_THAT(message_of<std::runtime_error>(
                 [&] { compute_kinematics(session, {.duration = 1, .step = 0.1, .elastic = true}); }),
             Contains("1 degree of freedom is not driven (angle of joint 'shaft')"));
  const MechanismFile bending = read_mechanism_text(strip("0.1*t"), "model.yaml");
  Session kinematic(bending.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(kinematic, {.duration = 1, .step = 0.1}); }),
             Contains("`inverse_dynamics` elastic ones as well"));
}
