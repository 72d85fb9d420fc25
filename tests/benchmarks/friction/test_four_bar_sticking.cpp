// A four-bar linkage whose four hinges are `stick_slip`, in space: its constraints repeat each other, so that reactions
// are those of smallest norm, and more joints stick than it has degrees of freedom. Each hinge passes dead centres of
// its own, at which it comes to rest while the rest of the loop moves on; at reversals of the linkage all come to rest
// at once; finally all stick. Thin bars of 1 kg/m as in tests/support/four_bar.hpp, released at rest. The reference is
// the equation of the crank's angle,
//     m_i a_i = sum F + m_i g,   I_i alpha_i = sum (r x F)_z -+ s_j mu r |F_j|,   a_i, alpha_i linear in the crank's,
// integrated from one change of a sign s_j of the relative rates to the next, which are located to rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/four_bar/loops.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/four_bar.hpp"
#include "tests/support/runge_kutta.hpp"

using bielle::mechanism::Session;
using bielle::test::FourBar;
using Catch::WithinAbs;

namespace test_four_bar_sticking {
namespace {

constexpr double gravity = 9.81, mu = 0.3, radius = 0.05;
constexpr std::array<double, 3> length{0.3, 0.9, 0.7};

using Plane = Eigen::Vector2d;
using Crank = Eigen::Vector2d;  ///< angle and rate
using Signs = std::array<double, 4>;

Plane turned(const Plane& r) { return {-r.y(), r.x()}; }

/// The bars from first to last pin, and their rates; crank, coupler, rocker.
struct Pose {
  std::array<Plane, 3> bar;
  std::array<double, 3> rate;
  Signs slip() const { return {rate[0], rate[1] - rate[0], rate[2] - rate[1], rate[2]}; }
};

/// The bars satisfy x bar_1' + y bar_2' = right, with ' a quarter of a turn.
std::array<double, 2> combination(const Pose& pose, const Plane& right) {
  const Plane p = turned(pose.bar[1]), q = -turned(pose.bar[2]);
  const double determinant = p.x() * q.y() - p.y() * q.x();
  return {(right.x() * q.y() - right.y() * q.x()) / determinant, (p.x() * right.y() - p.y() * right.x()) / determinant};
}

Pose pose_of(const Crank& z) {
  Pose pose;
  pose.bar[0] = length[0] * Plane(std::cos(z[0]), std::sin(z[0]));
  const Plane BD = Plane(1, 0) - pose.bar[0];
  const double distance = BD.norm();
  const double along = (length[1] * length[1] - length[2] * length[2] + distance * distance) / (2 * distance);
  pose.bar[1] = along / distance * BD + std::sqrt(length[1] * length[1] - along * along) / distance * turned(BD);
  pose.bar[2] = pose.bar[0] + pose.bar[1] - Plane(1, 0);
  const auto [coupler, rocker] = combination(pose, -z[1] * turned(pose.bar[0]));
  pose.rate = {z[1], coupler, rocker};
  return pose;
}

/// Returns the crank's angular acceleration. Friction by fixed-point iteration, which contracts by some mu
/// radius/length.
double acceleration(const Crank& z, const Signs& s) {
  const Pose pose = pose_of(z);
  const auto& [bar, rate] = pose;
  // Angular accelerations alpha_k + beta_k alpha_crank, of the middles gamma_k + delta_k alpha_crank.
  Plane centripetal = rate[0] * rate[0] * bar[0] + rate[1] * rate[1] * bar[1] - rate[2] * rate[2] * bar[2];
  const auto own = combination(pose, centripetal), by_crank = combination(pose, -turned(bar[0]));
  const std::array<double, 3> alpha{0, own[0], own[1]}, beta{1, by_crank[0], by_crank[1]};
  std::array<Plane, 3> gamma, delta;
  const auto swing = [&](int k, double share, double turn, double still) -> Plane {
    return share * (turn * turned(bar[k]) - still * bar[k]);
  };
  for (const int k : {0, 2}) {
    gamma[k] = swing(k, 0.5, alpha[k], rate[k] * rate[k]);
    delta[k] = swing(k, 0.5, beta[k], 0);
  }
  gamma[1] = swing(0, 1, alpha[0], rate[0] * rate[0]) + swing(1, 0.5, alpha[1], rate[1] * rate[1]);
  delta[1] = swing(0, 1, beta[0], 0) + swing(1, 0.5, beta[1], 0);
  // Unknown: alpha_crank; forces on the second body of a, b, c, d: ground-crank, crank-coupler, coupler-rocker,
  // ground-rocker. Joints at the bars' first and last pins: crank a b, coupler b c, rocker d c.
  constexpr int first[3] = {0, 1, 3}, last[3] = {1, 2, 2};
  constexpr double first_sign[3] = {1, 1, 1}, last_sign[3] = {-1, -1, 1};
  Eigen::Matrix<double, 9, 9> A = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> b;
  for (int k = 0; k < 3; ++k) {
    const double m = length[k], I = m * m * m / 12;
    A.block<2, 1>(3 * k, 0) = m * delta[k];
    b.segment<2>(3 * k) = m * (Plane(0, -gravity) - gamma[k]);
    A(3 * k + 2, 0) = I * beta[k];
    b[3 * k + 2] = -I * alpha[k];
    for (const auto& [pin, sign, half] :
         {std::tuple(first[k], first_sign[k], -0.5), std::tuple(last[k], last_sign[k], 0.5)}) {
      A.block<2, 2>(3 * k, 1 + 2 * pin) -= sign * Eigen::Matrix2d::Identity();
      A.block<1, 2>(3 * k + 2, 1 + 2 * pin) -= sign * half * turned(bar[k]).transpose();
    }
  }
  Eigen::Matrix<double, 9, 1> x = Eigen::Matrix<double, 9, 1>::Zero();
  for (int iteration = 0; iteration < 60; ++iteration) {
    Eigen::Matrix<double, 9, 1> right = b;
    for (int k = 0; k < 3; ++k)
      for (const auto& [pin, sign] : {std::pair(first[k], first_sign[k]), std::pair(last[k], last_sign[k])})
        right[3 * k + 2] -= sign * s[pin] * mu * radius * x.segment<2>(1 + 2 * pin).norm();
    const Eigen::Matrix<double, 9, 1> next = A.partialPivLu().solve(right);
    const double change = (next - x).norm();
    x = next;
    if (change <= 1e-14 * x.norm()) break;
  }
  return x[0];
}

struct Motion {
  Crank z{M_PI / 3, 0};
  Signs signs{};
  bool rests = false;
  int dead_centres = 0, reversals = 0;

  /// Tells whether a joint begins to move from rest or stays at rest.
  void leave_rest() {
    for (const double direction : {1.0, -1.0}) {
      const Signs slip = pose_of({z[0], direction}).slip();
      for (std::size_t j = 0; j < 4; ++j) signs[j] = slip[j] > 0 ? 1 : -1;
      if (acceleration(z, signs) * direction > 0) return;
    }
    rests = true;
  }

  void advance(double time) {
    constexpr double h = 1e-3;
    if (z[1] == 0) leave_rest();
    while (time > 0 && !rests) {
      const double step = std::min(h, time);
      Crank next = moved(step);
      double within = step;
      if (changes(next)) {
        double low = 0, high = step;
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (low + high);
          (changes(moved(middle)) ? high : low) = middle;
        }
        within = high;
        next = moved(high);
      }
      const Signs slip = pose_of(next).slip();
      z = next;
      time -= within;
      if (slip[0] * signs[0] < 0) {  // the rates of all bars follow from that of the crank
        ++reversals;
        z[1] = 0;
        leave_rest();
        continue;
      }
      for (std::size_t j = 0; j < 4; ++j)
        if (slip[j] * signs[j] < 0) {
          signs[j] = -signs[j];
          ++dead_centres;
        }
    }
  }

 private:
  Crank moved(double step) const {
    Crank next = z;
    bielle::test::advance_by_runge_kutta(next, step, 1, [&](const Crank& y) -> Crank {
      return {y[1], acceleration(y, signs)};
    });
    return next;
  }
  bool changes(const Crank& next) const {
    const Signs slip = pose_of(next).slip();
    for (std::size_t j = 0; j < 4; ++j)
      if (slip[j] * signs[j] < 0) return true;
    return false;
  }
};

std::string linkage(const std::string& friction) {
  using namespace bielle::four_bar;
  const auto [A, B, C, D] = bielle::test::released_four_bar();
  const auto rubbing = [&](std::string text) {
    text.insert(text.rfind('}'), fmt::format(", friction: {{{}coefficient: {}, radius: {}}}", friction, mu, radius));
    return text;
  };
  return "gravity: [0, -9.81, 0]\nnodes:\n" + bar_node("crank", A, B) + bar_node("coupler", B, C) +
         bar_node("rocker", D, C) + "elements:\n" + bar_body("crank", length[0]) + bar_body("coupler", length[1]) +
         bar_body("rocker", length[2]) + "joints:\n" + rubbing(hinge("a", "ground", "crank", A)) +
         rubbing(hinge("b", "crank", "coupler", B)) + rubbing(hinge("c", "coupler", "rocker", C)) +
         rubbing(hinge("d", "ground", "rocker", D));
}

double angle(double h, double end) {
  double value = 0;
  bielle::test::move_to(linkage("model: stick_slip, "), h, end,
                        [&](const Session& session) { value = M_PI / 3 + session.read("joints/a/coordinate")[0]; });
  return value;
}

}  // namespace

TEST_CASE("a four-bar with friction in all of its hinges swings as its equation, through dead centres and reversals") {
  Motion reference;
  reference.advance(1.5);
  CAPTURE(reference.dead_centres, reference.reversals, reference.z[0]);
  CHECK(reference.dead_centres >= 2);
  CHECK(reference.reversals >= 1);
  const double swinging = reference.z[0];
  const double coarse = angle(4e-3, 1.5) - swinging, middle = angle(2e-3, 1.5) - swinging,
               fine = angle(1e-3, 1.5) - swinging;
  CAPTURE(coarse, middle, fine);
  CHECK(std::log2(std::abs(coarse / middle)) == Approx(2).margin(0.2));
  CHECK(std::log2(std::abs(middle / fine)) == Approx(2).margin(0.2));
  CHECK(std::abs((4 * fine - middle) / 3) < 0.1 * std::abs(fine));
}

TEST_CASE("a four-bar with friction in all of its hinges comes to rest where its equation does, and stays") {
  Motion reference;
  reference.advance(100);
  REQUIRE(reference.rests);
  double at_10 = 0, creep = 0;
  bielle::test::move(linkage("model: stick_slip, "), 2e-3, 12, [&](const Session& session) {
    const double value = M_PI / 3 + session.read("joints/a/coordinate")[0];
    if (session.time() <= 10)
      at_10 = value;
    else
      creep = std::max(creep, std::abs(value - at_10));
  });
  CHECK_THAT(at_10, WithinAbs(reference.z[0], 2e-4));
  CHECK(creep < 1e-10);
}

}  // namespace test_four_bar_sticking
