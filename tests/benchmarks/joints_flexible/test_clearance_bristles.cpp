// Bristles (LuGre) in joints with play, against closed forms: a journal that a moment holds up in its bush without
// creep, one that turns steadily at the angle of friction; derivatives are exact, and no deflection generates power.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

constexpr double g = 9.81, m = 2, r = 0.02, mu = 0.3, sigma_0 = 2e4, gap = 1e-4;

/// Returns a journal that lies in its bush, or a ball in its socket, where oil damps it: along the bore it would swing
/// for long.
/// @param node  further keys of its node @param rest  sections
std::string lying(const std::string& type, const std::string& node, const std::string& rest = "") {
  const double depth = std::pow(m * g / 1e8, 1 / 1.5);
  return fmt::format(
      "gravity: [0, -{}, 0]\n"
      "nodes: {{journal: {{position: [0, {:.17g}, 0]{}}}}}\n"
      "elements: {{journal: {{type: rigid_body, node: journal, mass: {}, inertia: [4e-4, 4e-4, 4e-4]}}}}\n"
      "joints:\n"
      "  it: {{type: {}, nodes: [ground, journal], at: [[0, 0, 0], [0, 0, 0]], radial_gap: {}, radius: {}, contact: "
      "{{stiffness: 1e8, damping: 2}}, damping: {{x: 300, y: 300}}, friction: {{model: lugre, coefficient: {}, "
      "bristle_stiffness: {}, "
      "bristle_damping: 300}}}}\n{}",
      g, -gap - depth, node, m, type, gap, r, mu, sigma_0, rest);
}

}  // namespace

TEST_CASE("a moment that friction bears holds a journal up in its bush for 100 s") {
  // About its middle friction alone has a moment, T r = M; along the bore T = m g sin(phi): phi from the lowest place.
  const double moment = 0.5 * m * g * r * std::sin(std::atan(mu)), phi = std::asin(moment / (m * g * r));
  for (const char* type : {"clearance_hinge, axis: [0, 0, 1], second_axis: [1, 0, 0]", "clearance_spherical"}) {
    CAPTURE(type);
    double settled = 0, creep = 0, x = 0, y = 0;
    const std::string hinge = type;
    move(lying(type, ", fixed: [z, rx, ry]",
               fmt::format("loads: {{turn: {{node: journal, moment: [0, 0, {:.17g}]}}}}\n", moment)),
         5e-3, 100, [&](const Session& session) {
           const std::vector<double> q = session.read("joints/it/coordinate");
           x = q[0];
           y = q[1];
           if (session.time() < 5)
             settled = q.back();
           else
             creep = std::max(creep, std::abs(q.back() - settled));
         });
    CHECK_THAT(std::atan2(-x, -y), WithinRel(phi, 1e-4));
    // The bristle yields by T/(N sigma_0) = tan(phi)/sigma_0.
    CHECK(r * creep < 1e-3 * std::tan(phi) / sigma_0);
  }
}

TEST_CASE("a journal that turns steadily lies at the angle of friction") {
  for (const char* type : {"clearance_hinge, axis: [0, 0, 1], second_axis: [1, 0, 0]", "clearance_spherical"}) {
    CAPTURE(type);
    double x = 0, y = 0, N = 0;
    move(lying(type, ", fixed: [z, rx, ry], motion: {rz: '4*t'}"), 1e-4, 2, [&](const Session& session) {
      x = session.read("joints/it/coordinate")[0];
      y = session.read("joints/it/coordinate")[1];
      N = session.read("joints/it/normal_force")[0];
    });
    CHECK_THAT(std::abs(x / y), WithinRel(mu, 1e-4));
    CHECK_THAT(N, WithinRel(m * g * std::cos(std::atan(mu)), 1e-4));
  }
}

TEST_CASE("derivatives within a step of a clearance with bristles are exact, and what is lost is never gained") {
  for (const char* type : {"clearance_hinge, axis: [1, 2, 3], length: 0.6, axial_gap: 0.02", "clearance_spherical"}) {
    CAPTURE(type);
    const MechanismFile file = read_mechanism_text(
        fmt::format(
            "nodes:\n"
            "  a: {{position: [0.1, 0.05, -0.1], rotation_vector: [0.1, -0.2, 0.3]}}\n"
            "  b: {{position: [0.4, 0.3, 0.3], rotation_vector: [-0.2, 0.1, 0.2]}}\n"
            "joints:\n"
            "  it: {{type: {}, nodes: [a, b], at: [[0, 0, 0], [0, 0, 0]], radial_gap: 0.01, radius: 0.3, "
            "contact: {{stiffness: 3, exponent: 2, damping: 0.1}}, friction: {{model: lugre, coefficient: 0.4, "
            "static: 0.6, stribeck_velocity: 2, viscous: 0.1, bristle_stiffness: 1.5, bristle_damping: 0.8}}}}\n",
            type),
        "model.yaml");
    const DenseModel dense(file.model);
    Random random(7);
    for (int round = 0; round < 5; ++round) {
      CAPTURE(round);
      State state = dense.start();
      dense.move(state, 0.05 * random.vector(dense.size()));
      dense.move_rates(state, random.vector(dense.size()));
      // The bristle follows the joint's own memory: whether a place touches, and damping.
      const Eigen::Index places = type[10] == 'h' ? 4 : 1, first = state.memory.size() - 1 - 5 * places;
      for (Eigen::Index k = 0; k < places; ++k) {
        state.memory[first + 5 * k] = 1;
        state.memory.segment<3>(first + 5 * k + 2) = random.vector3(2);
      }
      state.memory[state.memory.size() - 1] = 0.1;
      state.time = 0.3;
      const VectorX residual = dense.residual(state), v = dense.rates(state);
      REQUIRE(residual.norm() > 0);
      const Energy energy = dense.energy(state);
      const double stored =
          derivative([&](double s) { return dense.energy(dense.along_motion(state, s)).elastic; }, 1e-4);
      CHECK(energy.dissipation >= 0);
      CHECK_THAT(residual.dot(v),
                 WithinAbs(stored + energy.dissipation - energy.input, 1e-9 * residual.norm() * v.norm()));
      for (const auto part : {DenseModel::Part::K, DenseModel::Part::C}) {
        const MatrixX tangent = dense.tangent(state, part);
        for (int j = 0; j < dense.size(); ++j) {
          const VectorX column = derivative(
              [&](double s) -> VectorX {
                State moved = state;
                const VectorX step = s * VectorX::Unit(dense.size(), j);
                part == DenseModel::Part::K ? dense.move(moved, step) : dense.move_rates(moved, step);
                return dense.residual(moved);
              },
              1e-3);
          CHECK((tangent.col(j) - column).norm() <= 1e-8 * (1 + tangent.norm()));
        }
      }
    }
  }
}
