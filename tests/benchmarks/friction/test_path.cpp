// Friction along a path: the normal force is the reaction normal to it.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_path {
namespace {

/// Returns a bead of 2 kg on a wire. @param more  keys of its node and of the model
std::string bead(const std::string& curve, bool closed, const std::string& node, const std::string& friction,
                 const std::string& more = "") {
  return fmt::format(
      "{}nodes: {{bead: {{{}, fixed: [rx, ry, rz]}}}}\n"
      "elements: {{bead: {{type: point_mass, node: bead, mass: 2}}}}\n"
      "joints: {{wire: {{type: point_on_curve, nodes: [ground, bead], curve: {}, closed: {}, friction: {{{}}}}}}}\n",
      more, node, curve, closed, friction);
}

constexpr const char* gravity = "gravity: [0, 0, -9.81]\n";

double read(const Session& session, const char* what) { return session.read(std::string("joints/wire/") + what)[0]; }

}  // namespace

TEST_CASE("on a straight wire a bead slides and sticks as a block on an incline") {
  const bielle::test::TemporaryFolder folder;
  const std::string line = folder / "line.csv";
  std::ofstream(line) << "0,0,0\n2.5,0,-0.5\n5,0,-1\n";  // down by tan(angle) = 0.2
  const double angle = std::atan(0.2), g = 9.81, N = 2 * g * std::cos(angle);
  const std::string at = "position: [0.5, 0, -0.1]";
  move_to(bead(line, false, at, "model: stick_slip, coefficient: 0.21", gravity), 0.01, 2, [&](const Session& session) {
    CHECK_THAT(read(session, "coordinate"), WithinAbs(0, 1e-14));
    CHECK(read(session, "sticks") == 1);
    CHECK_THAT(read(session, "normal_force"), WithinRel(N, 1e-10));
  });
  const double a = g * (std::sin(angle) - 0.15 * std::cos(angle));
  move_to(bead(line, false, at, "model: stick_slip, coefficient: 0.15", gravity), 0.01, 2, [&](const Session& session) {
    CHECK_THAT(read(session, "coordinate"), WithinRel(2 * a, 1e-9));  // the scheme is exact for it
    CHECK_THAT(read(session, "normal_force"), WithinRel(N, 1e-9));
    CHECK_THAT(session.balance(), WithinAbs(0, 1e-8));
  });
  // With bristles, N sigma_0 z balances the slope.
  move_to(
      bead(line, false, at, "model: lugre, bristle_stiffness: 2e4, bristle_damping: 300, coefficient: 0.25", gravity),
      1e-3, 20, [&](const Session& session) {
        CHECK_THAT(read(session, "bristles"), WithinRel(0.2 / 2e4, 1e-8));
        CHECK_THAT(read(session, "rate"), WithinAbs(0, 1e-12));
      });
}

// m vdot = -mu m v^2 kappa along a plane curve, so that v = v_0 exp(-mu turn), turn the angle of the velocity: the
// inertial counterpart of the capstan.
TEST_CASE("without gravity a bead slows down by the angle through which its wire has turned it") {
  const bielle::test::TemporaryFolder folder;
  const std::string ellipse = folder / "ellipse.csv";
  std::ofstream file(ellipse);
  constexpr int points = 200;
  for (int k = 0; k < points; ++k)
    file << fmt::format("{:.17g},{:.17g},0\n", 1.5 * std::cos(2 * M_PI * k / points), std::sin(2 * M_PI * k / points));
  file.close();
  const double mu = 0.15;
  double worst = 0, turned = 0, last = M_PI / 2;
  const auto error_of = [&](double h) {
    worst = turned = 0, last = M_PI / 2;
    move(bead(ellipse, true, "position: [1.5, 0, 0], velocity: [0, 2, 0]", "model: stick_slip, coefficient: 0.15"), h,
         3, [&](const Session& session) {
           const auto& v = session.node("bead").v;
           const double direction = std::atan2(v.y(), v.x());
           turned += std::remainder(direction - last, 2 * M_PI);
           last = direction;
           worst = std::max(worst, std::abs(std::log(v.norm() / 2) + mu * turned));
         });
    return worst;
  };
  const double coarse = error_of(4e-3), fine = error_of(2e-3);
  CHECK(turned > 3);
  CHECK(fine < 2e-5);
  CHECK_THAT(coarse / fine, WithinAbs(4, 0.8));  // order 2
}

// The equation of motion along the wire, m (|c'| u'' + t . c'' u'^2 - g . t) = -N mu tanh(v/v_0),
// N = m |(I - t t^T)(c'' u'^2 - g)|, c the cubic spline through the points with periodic ends by chord length, solved
// by tests/references/bead_on_wire.py: arc, rate and normal force at 1.5 s.
TEST_CASE("a bead on a curve in space follows its equation of motion") {
  const bielle::test::TemporaryFolder folder;
  const std::string wire = folder / "wire.csv";
  std::ofstream file(wire);
  constexpr int points = 240;
  for (int k = 0; k < points; ++k) {
    const double a = 2 * M_PI * k / points;
    file << fmt::format("{:.17g},{:.17g},{:.17g}\n", std::cos(a), 0.3 * std::sin(2 * a), 0.8 * std::sin(a));
  }
  file.close();
  const bielle::test::ReferenceTable exact("bead_on_wire");
  const double arc = exact("arc"), rate = exact("rate"), N = exact("normal_force");
  const auto error_of = [&](double h) {
    double error = 0;
    move_to(
        bead(wire, true, "position: [1, 0, 0], velocity: [0, 3.6, 4.8]", "coefficient: 0.15, velocity: 0.02", gravity),
        h, 1.5, [&](const Session& session) {
          error = read(session, "coordinate") - arc;
          CHECK_THAT(read(session, "rate"), WithinAbs(rate, 1e-4));
          // The spline's third derivative jumps at its points, so that the force converges less regularly.
          CHECK_THAT(read(session, "normal_force"), WithinRel(N, 1e-4));
          CHECK_THAT(session.balance(), WithinAbs(0, 1e-3));
        });
    return error;
  };
  const double coarse = error_of(1e-3), fine = error_of(5e-4);
  CHECK_THAT(coarse / fine, WithinAbs(4, 0.2));
  CHECK_THAT(fine - (coarse - fine) / 3, WithinAbs(0, 1e-7));  // the error of order 2 is removed by extrapolation
}

TEST_CASE("a slider on a stiff beam slides and sticks as a block on an incline") {
  const auto slider = [](const std::string& friction) {
    return fmt::format(
        "{}nodes:\n"
        "  a: {{position: [0, 0, 0], fixed: true}}\n"
        "  b: {{position: [2.5, 0, -0.5], fixed: true}}\n"
        "  s: {{position: [0.5, 0, -0.1], fixed: [rx, ry, rz]}}\n"
        "elements:\n"
        "  rail: {{type: beam, nodes: [a, b], elements: 4, section: {{circle: 0.05, young: 2e15, poisson: 0.3, "
        "density: "
        "1}}}}\n"
        "  mass: {{type: point_mass, node: s, mass: 2}}\n"
        "joints: {{wire: {{type: slider, node: s, beam: rail, start: 0.2, friction: {{{}}}}}}}\n",
        gravity, friction);
  };
  const double angle = std::atan(0.2), g = 9.81, N = 2 * g * std::cos(angle);
  const double a = g * (std::sin(angle) - 0.15 * std::cos(angle));
  for (const char* model : {"model: stick_slip", "model: lugre, bristle_stiffness: 2e5, bristle_damping: 3000"}) {
    CAPTURE(model);
    // The bead crosses from element to element; the rail bends by 1e-9 of its length.
    move_to(slider(fmt::format("{}, coefficient: 0.15", model)), 1e-3, 1.5, [&](const Session& session) {
      // Bristles yield by mu/sigma_0 first, and their damping takes an impulse N sigma_1 mu/sigma_0 from the motion.
      CHECK_THAT(read(session, "rate"),
                 WithinAbs(1.5 * a, std::string(model) == "model: stick_slip" ? 1e-6 : N / 2 * 3000 * 0.15 / 2e5));
      CHECK_THAT(read(session, "normal_force"), WithinRel(N, 1e-4));
    });
    move_to(slider(fmt::format("{}, coefficient: 0.25", model)), 1e-3, 1.5, [&](const Session& session) {
      CHECK_THAT(read(session, "rate"), WithinAbs(0, 1e-8));
      CHECK_THAT(read(session, "friction"), WithinRel(-2 * g * std::sin(angle), 1e-6));
    });
  }
}

}  // namespace test_path
