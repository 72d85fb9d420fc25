// Gear meshes whose stiffness varies with the position of the teeth, and errors of teeth.
#include <array>
#include <cmath>
#include <complex>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/joints/gears/iso_stiffness.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/runge_kutta.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_mesh_stiffness {
namespace {

constexpr double r_1 = 0.02, r_2 = 0.05, J_2 = 2e-3, alpha = M_PI / 9;
const double base_1 = r_1 * std::cos(alpha), base_2 = r_2 * std::cos(alpha), m = J_2 / (base_2 * base_2);

/// Wheel 1 turns at a constant rate; wheel 2 has inertia.
std::string driven(double rate, const std::string& mesh, const std::string& more = "") {
  return fmt::format(R"yaml(
nodes:
  w1: {{}}
  w2: {{position: [0.07, 0, 0]}}
elements:
  b2: {{type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, {:.17g}]}}
joints:
  h1: {{type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, w2], axis: [0, 0, 1]{}}}
  teeth: {{type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05]{}}}
drives: {{motor: {{joint: h1, angle: "{:.17g}*t"}}}}
)yaml",
                     J_2, more, mesh, rate);
}

double read(const Session& session, const std::string& what) { return session.read("joints/" + what)[0]; }

double error_of_transmission(const Session& session) { return read(session, "teeth/transmission_error"); }

}  // namespace

// ISO/TR 6336-30:2017, example 1: m_n = 8 mm, z = 17, 103, x = 0.145, 0, beta = 15.8 deg, b = 100 mm, basic rack with
// h_fP = 1.4 m_n, distance of axes 500 mm. Its results (N/(mm um)): c'_th = 17.85584, c' = 12.37047, c_gamma_alpha
// = 17.46485, hence eps_alpha = 1.54909.
TEST_CASE("the stiffness of ISO 6336-1 is that of the example of ISO/TR 6336-30") {
  using namespace bielle::mechanism;
  CylindricalTeeth pair{0.1, {17, 103}, {0.145, 0}, alpha, 15.8 * M_PI / 180};
  pair.dedendum = 1.4;
  const IsoStiffness k = iso_stiffness(pair, 1.54909);
  CHECK_THAT(k.single, WithinRel(12.37047e9, 1e-6));
  CHECK_THAT(k.mesh, WithinRel(17.46485e9, 1e-6));
  // The stiffness is along the normal, which is inclined to the transverse plane by the helix angle at the base
  // cylinder: tan(beta_b) = tan(beta) cos(alpha_t).
  const double transverse = std::atan(std::tan(alpha) / std::cos(pair.helix));
  const double base = std::atan(std::tan(pair.helix) * std::cos(transverse));
  CHECK_THAT(k.normal, WithinRel(0.1 * k.mesh / std::pow(std::cos(base), 2), 1e-12));
  // Its teeth without shortened tips have a slightly longer path of contact.
  CHECK_THAT(transverse_contact_ratio(pair), WithinAbs(1.549, 0.01));
  // Two racks touch along 2 m/sin(alpha), and their base pitch is pi m cos(alpha).
  CHECK_THAT(transverse_contact_ratio({0.1, {1e7, 1e7}, {}, alpha, 0}),
             WithinRel(2 / (std::sin(alpha) * M_PI * std::cos(alpha)), 1e-5));
}

TEST_CASE("the load on teeth of varying stiffness gives their static transmission error") {
  // Wheel 2 is held. The work of the torque M is F r_b + k' p^2/2, and TE = -p.
  for (const double angle : {0.0, 0.1, 0.2}) {
    const std::string text = fmt::format(R"yaml(
nodes: {{w1: {{}}, w2: {{position: [0.07, 0, 0]}}}}
joints:
  h1: {{type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}}
  teeth: {{type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e7*(1 + 0.3*sin(20*phi)), errors: 3e-6}}
drives: {{motor: {{joint: h1, torque: 40}}, hold: {{joint: h2, angle: {:.17g}}}}}
measures: {{force: teeth.force, error: teeth.transmission_error, turned: teeth.angle_1, k: teeth.stiffness, p: teeth.deformation}}
)yaml",
                                         -0.4 * angle);
    const auto file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    compute_statics(session);
    const double phi = read(session, "h1/coordinate"), k = 1e7 * (1 + 0.3 * std::sin(20 * phi)),
                 slope = 6e7 * std::cos(20 * phi), p = base_1 * (phi - angle) + 3e-6;
    CHECK_THAT(phi, WithinAbs(angle, 0.02));
    CHECK_THAT(k * p * base_1 + 0.5 * slope * p * p, WithinRel(40, 1e-9));
    CHECK_THAT(error_of_transmission(session), WithinRel(3e-6 - k * p / k, 1e-9));
    CHECK_THAT(session.measure("force"), WithinRel(k * p, 1e-9));
    CHECK_THAT(session.measure("error"), WithinRel(3e-6 - p, 1e-9));
    CHECK_THAT(session.measure("turned"), WithinRel(phi, 1e-12));
    CHECK_THAT(session.measure("k"), WithinRel(k, 1e-12));
    CHECK_THAT(session.measure("p"), WithinRel(p, 1e-9));
  }
}

TEST_CASE("a stiffness by the angles of both wheels has a parametric torque on each of them") {
  // V = k(phi_1, phi_2) p^2/2, p = r_b1 phi_1 + r_b2 phi_2: the torques on both wheels are its derivatives.
  for (const double angle : {0.1, 0.2, 0.37}) {
    const std::string text = fmt::format(R"yaml(
nodes: {{w1: {{}}, w2: {{position: [0.07, 0, 0]}}}}
joints:
  h1: {{type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}}
  teeth: {{type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e7*(1 + 0.3*sin(20*phi)*cos(8*phi_2))}}
drives: {{motor: {{joint: h1, torque: 40}}, hold: {{joint: h2, angle: {:.17g}}}}}
measures: {{k: teeth.stiffness, p: teeth.deformation, lead: teeth.approach}}
)yaml",
                                         -0.4 * angle);
    const auto file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    compute_statics(session);
    const double phi = read(session, "h1/coordinate"), phi_2 = -0.4 * angle,
                 k = 1e7 * (1 + 0.3 * std::sin(20 * phi) * std::cos(8 * phi_2)),
                 by_1 = 6e7 * std::cos(20 * phi) * std::cos(8 * phi_2),
                 by_2 = -2.4e7 * std::sin(20 * phi) * std::sin(8 * phi_2), p = base_1 * phi + base_2 * phi_2;
    CHECK_THAT(session.measure("k"), WithinRel(k, 1e-12));
    CHECK_THAT(session.measure("p"), WithinRel(p, 1e-9));
    CHECK_THAT(session.measure("lead"), WithinRel(p / std::cos(alpha), 1e-9));
    CHECK_THAT(session.measure("lead"), WithinRel(read(session, "teeth/approach"), 1e-12));
    CHECK_THAT(k * p * base_1 + 0.5 * by_1 * p * p, WithinRel(40, 1e-9));
    CHECK_THAT(read(session, "h2/drive_force"), WithinRel(k * p * base_2 + 0.5 * by_2 * p * p, 1e-9));
    CHECK(std::abs(0.5 * by_2 * p * p) > 1e-4 * k * p * base_2);  // the parametric torque is observed
  }
}

TEST_CASE("rigid teeth have the transmission error of their flanks, and the force that it takes") {
  // The error has a wave for each pitch of wheel 1, by a table of 48 points, and one for a turn of wheel 2.
  const double rate = 3, wave = 2e-4, eccentric = 5e-4;
  std::string rows;
  for (int k = 0; k <= 48; ++k)
    rows += fmt::format("[{:.17g}, {:.17g}], ", k / 48.0, k == 48 ? 0 : wave * std::sin(2 * M_PI * k / 48));
  const std::string errors =
      fmt::format(", errors: [{{table: [{}], teeth: 20}}, {{formula: {}*cos(phi), wheel: 2}}]", rows, eccentric);
  move(driven(rate, errors), 1e-3, 0.2, [&](const Session& session) {
    const double phi = rate * session.time(), phi_2 = read(session, "h2/coordinate");
    const double e = wave * std::sin(20 * phi) + eccentric * std::cos(phi_2);
    CHECK_THAT(error_of_transmission(session), WithinAbs(e, 2e-6 * wave));  // error of the spline: (2 pi/48)^4/384
    CHECK_THAT(phi_2, WithinAbs(-(base_1 * phi + e) / base_2, 1e-6 * wave / base_2));
  });
  // F r_b2 = J_2 times the acceleration of wheel 2.
  const auto error_of_force = [&](double h) {
    double largest = 0;
    const std::string sine = fmt::format(", errors: {}*sin(20*phi)", wave);
    move(driven(rate, sine) + "measures: {force: teeth.force}\n", h, 0.2, [&](const Session& session) {
      const double force = -3600 * m * wave * std::sin(60 * session.time());
      largest = std::max(largest, std::abs(session.measure("force") - force));
    });
    return largest;
  };
  const double coarse = error_of_force(2e-3), fine = error_of_force(1e-3);
  CHECK(fine < 0.05 * 3600 * m * wave);
  CHECK_THAT(std::log2(coarse / fine), WithinAbs(2, 0.2));
}

TEST_CASE("far below resonance a profile error is the transmission error, far above it the wheels do not follow") {
  const double k = 1e7, zeta = 0.1, natural = std::sqrt(k / m), d = 2 * zeta * std::sqrt(k * m), E = 1e-5;
  for (const double ratio : {0.08, 0.5, 4.0}) {
    const double w = ratio * natural, h = 2 * M_PI / std::max(w, natural) / 100;
    const std::string text =
        driven(w / 20, fmt::format(", stiffness: {}, damping: {:.17g}, errors: {}*sin(20*phi)", k, d, E));
    const std::complex<double> stiff(k, d * w), response = stiff / (stiff - m * w * w);
    double error = 0;
    const double end = 14 / natural / zeta + 2 * M_PI / w;
    move(text, h, end, [&](const Session& session) {
      if (session.time() < 14 / natural / zeta) return;
      const double expected = E * std::imag(response * std::polar(1.0, w * session.time()));
      error = std::max(error, std::abs(error_of_transmission(session) - expected));
    });
    CHECK(error < 4e-3 * E * std::max(1.0, std::abs(response)));  // (2 pi/100)^2 and the rest e^-14 of the start
    if (ratio < 0.1) CHECK_THAT(std::abs(response), WithinAbs(1, 0.01));
    if (ratio > 3) CHECK(std::abs(response) < 0.1);
  }
}

// The deformation p of a pair with k (1 + eps cos(z phi)) obeys m p'' + d p' + k (1 + eps cos(W t)) p = 0: Mathieu's
// equation with damping. At W = 2 w it is unstable beyond eps = 4 zeta (first order; A. H. Nayfeh, D. T. Mook,
// Nonlinear Oscillations, 5.3). The multipliers of a period are computed here by the test's own integration.
TEST_CASE("the stiffness of the mesh makes a gear pair unstable beyond Mathieu's boundary") {
  const double k = 1e7, zeta = 0.02, natural = std::sqrt(k / m), W = 2 * natural, period = 2 * M_PI / W;
  const double d = 2 * zeta * std::sqrt(k * m);
  const auto growth = [&](double eps) {  // factor of the displacement from one period to the next
    Eigen::Matrix2d Z = Eigen::Matrix2d::Identity();
    double t = 0;
    for (int n = 0; n < 400; ++n) {
      Eigen::Matrix<double, 5, 1> z;
      z << Z.reshaped(), t;
      bielle::test::advance_by_runge_kutta(z, period / 400, 1, [&](const Eigen::Matrix<double, 5, 1>& y) {
        Eigen::Matrix<double, 5, 1> rate;
        const double stiff = natural * natural * (1 + eps * std::cos(W * y[4]));
        for (const int c : {0, 2}) {
          rate[c] = y[c + 1];
          rate[c + 1] = -2 * zeta * natural * y[c + 1] - stiff * y[c];
        }
        rate[4] = 1;
        return rate;
      });
      Z = z.head<4>().reshaped(2, 2);
      t = z[4];
    }
    const double half = 0.5 * Z.trace();
    return std::abs(half) + std::sqrt(std::max(0.0, half * half - Z.determinant()));  // larger of two real multipliers
  };
  CHECK(growth(0.95 * 4 * zeta) < 1);
  CHECK(growth(1.05 * 4 * zeta) > 1);
  for (const double eps : {0.8 * 4 * zeta, 1.2 * 4 * zeta}) {
    const std::string text =
        driven(W / 20, fmt::format(", stiffness: {}*(1 + {:.17g}*cos(20*phi)), damping: {:.17g}", k, eps, d),
               fmt::format(", start_rate: {:.17g}", -W / 20 * r_1 / r_2 + 1e-3));
    const int first = 60, last = 80;  // the other multiplier has decayed
    std::array<double, 2> seen{};
    int step = 0;
    const int per_period = 80;
    move(text, period / per_period, last * period, [&](const Session& session) {
      ++step;
      if (step == first * per_period) seen[0] = error_of_transmission(session);
      if (step == last * per_period) seen[1] = error_of_transmission(session);
    });
    REQUIRE(seen[0] != 0);
    const double found = std::pow(std::abs(seen[1] / seen[0]), 1.0 / (last - first));
    CHECK((found > 1) == (eps > 4 * zeta));
    CHECK_THAT(std::log(found), WithinAbs(std::log(growth(eps)), 0.02 * M_PI * zeta));
  }
}

TEST_CASE("energy is conserved by teeth whose stiffness varies, at any motion") {
  // Two free wheels turn with their teeth pressed together: the parametric torque reduces their rotation.
  const std::string text = R"yaml(
nodes: {w1: {}, w2: {position: [0.07, 0, 0]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 2e-3]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1], start_rate: 20}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1], start_rate: -7}
  teeth: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05], stiffness: 1e5*(1 + 0.5*sin(20*phi)), errors: 1e-5*cos(20*phi)}
)yaml";
  std::array<double, 2> drift{};
  for (const std::size_t n : {0, 1})
    move(text, 2e-4 / (n + 1), 0.1, [&](const Session& session) {
      const auto energy = session.energy();
      drift[n] = std::max(
          drift[n], std::abs(energy.kinetic + energy.elastic - 0.5 * (1e-3 * 400 + 2e-3 * 49) - 0.5 * 1e5 * 1e-10));
    });
  CHECK(drift[1] < 1e-3 * 0.25);
  CHECK_THAT(std::log2(drift[0] / drift[1]), WithinAbs(2, 0.3));
}

}  // namespace test_mesh_stiffness
