// Tracking of modes alone: two oscillators whose springs change, with and without a spring between them.
#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

#include <catch2/catch.hpp>

#include "mechanism/solvers/linearised/speed_sweep.hpp"

using namespace bielle::mechanism;
using Complex = std::complex<double>;

namespace test_mode_tracking {
namespace {

constexpr double two_pi = 2 * std::numbers::pi, at_rest = 100, slope = 0.8;

/// Masses 1; springs 100 + 0.8 p and 100 - 0.8 p to the ground, and `between` them: w^2 = 100 + between -+
/// sqrt(between^2 + (0.8 p)^2), shapes turn from one mass to the other within p of the size of between/0.8.
SweepSample oscillators(double p, double between) {
  SweepSample sample;
  sample.speed = p;
  sample.modes.all = true;
  sample.modes.M.resize(2, 2);
  sample.modes.M.setIdentity();
  const double root = std::hypot(between, slope * p);
  for (const double sign : {-1.0, 1.0}) {
    Mode mode;
    mode.s = Complex(0, std::sqrt(at_rest + between + sign * root));
    const double angle = 0.5 * std::atan2(-between, slope * p);  // stiffness of the larger spring
    mode.u = sign > 0 ? Eigen::Vector2cd(std::cos(angle), std::sin(angle))
                      : Eigen::Vector2cd(-std::sin(angle), std::cos(angle));
    mode.u *= std::polar(2.0, 1.3 * p + sign);  // arbitrary size and phase
    sample.modes.modes.push_back(mode);
    sample.modes.whirl.push_back(0);
  }
  return sample;
}

SweptModes swept(double between, const std::vector<double>& values) {
  return SpeedSweep([&](double p, int /*count*/) { return oscillators(p, between); }, values, 2, {1}).run();
}

std::vector<double> even(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
  return values;
}

}  // namespace

TEST_CASE("modes that cross keep their numbers, which sorting by frequency would swap", "[linearised]") {
  for (const int count : {2, 4, 5, 12}) {  // with 5 values one is where they coincide
    const SweptModes found = swept(0, even(-30, 30, count));
    CAPTURE(count);
    CHECK(found.uncertain.empty());
    for (const SweepPoint& point : found.points) {
      CHECK(std::abs(point.tracks[0].s.imag()) == Approx(std::sqrt(at_rest + slope * point.value)).epsilon(1e-12));
      CHECK(std::abs(point.tracks[1].s.imag()) == Approx(std::sqrt(at_rest - slope * point.value)).epsilon(1e-12));
      CHECK(point.tracks[0].correlation == Approx(1).epsilon(1e-12));
    }
    REQUIRE(found.meetings.size() == 1);
    CHECK_FALSE(found.meetings[0].veering);
    // The frequencies are straight lines there, up to (slope p/200)^2 relative to each other.
    CHECK(std::abs(found.meetings[0].value) < 1e-6);
    CHECK(found.meetings[0].frequency == Approx(10 / two_pi).epsilon(3e-3));
  }
}

TEST_CASE("modes that veer are told, with the gap that is left and the exchange of their shapes", "[linearised]") {
  for (const double between : {0.5, 2.0, 8.0}) {
    const SweptModes found = swept(between, even(-60, 61, 30));
    CAPTURE(between);
    CHECK(found.uncertain.empty());
    REQUIRE(found.meetings.size() == 1);
    const ModeMeeting& veering = found.meetings[0];
    CHECK(veering.veering);
    // Between the springs' -p and +p the problem is symmetric up to the curvature of the square root, (between/200)^2.
    const double gap = (std::sqrt(at_rest + 2 * between) - std::sqrt(at_rest)) / two_pi;
    CHECK(veering.gap == Approx(gap).epsilon(0.02));
    CHECK(std::abs(veering.value) < 0.1 * between / slope);
    // Each track stays on its side: the lower one remains the lower one.
    for (const SweepPoint& point : found.points) CHECK(std::abs(point.tracks[0].s) < std::abs(point.tracks[1].s));
    // Its shape is now that of the other mass.
    CHECK(std::abs(found.points.front().tracks[0].u[0]) > 10 * std::abs(found.points.front().tracks[0].u[1]));
    CHECK(std::abs(found.points.back().tracks[0].u[1]) > 10 * std::abs(found.points.back().tracks[0].u[0]));
  }
}

TEST_CASE("frequencies that come near without an exchange of shapes are no veering", "[linearised]") {
  // The eigenvalues are 100 + p^2/100 and 120: the shapes do not change.
  const auto solve = [](double p, int /*count*/) {
    SweepSample sample;
    sample.modes.all = true;
    sample.modes.M.resize(2, 2);
    sample.modes.M.setIdentity();
    for (int k = 0; k < 2; ++k) {
      Mode mode;
      mode.s = Complex(0, k == 0 ? 10 - p * p / 1000 : 10.1);
      mode.u = Eigen::Vector2cd::Unit(k);
      sample.modes.modes.push_back(mode);
      sample.modes.whirl.push_back(0);
    }
    return sample;
  };
  CHECK(SpeedSweep(solve, even(-30, 30, 13), 2, {1}).run().meetings.empty());
}

TEST_CASE("a critical speed is located where a frequency is a multiple of the speed", "[linearised]") {
  // sqrt(100 + 0.8 p) = n p.
  SpeedSweep sweep([](double p, int /*count*/) { return oscillators(p, 0); }, even(1, 40, 9), 2, {1, 2});
  const SweptModes found = sweep.run();
  REQUIRE(found.critical.size() == 4);
  for (const CriticalSpeed& each : found.critical) {
    const double n = each.order, rising = each.mode == 0 ? -slope : slope;  // at first the slower one falls
    const double exact =
        (std::copysign(1.0, rising) * slope + std::sqrt(slope * slope + 4 * n * n * at_rest)) / (2 * n * n);
    CAPTURE(n, each.mode);
    CHECK(each.speed == Approx(exact).epsilon(1e-9));
    CHECK(each.frequency == Approx(n * exact / two_pi).epsilon(1e-9));
  }
}

TEST_CASE("a mode that no longer oscillates is lost, and told", "[linearised]") {
  const auto solve = [](double p, int /*count*/) {
    SweepSample sample = oscillators(p, 0);
    if (p > 20) sample.modes.modes.pop_back();
    return sample;
  };
  const SweptModes found = SpeedSweep(solve, even(1, 40, 14), 2, {3}).run();
  REQUIRE(found.uncertain.size() == 1);
  CHECK(found.uncertain[0].lost);
  CHECK(found.uncertain[0].from < 20);
  CHECK(found.uncertain[0].to > 20);
  CHECK(found.uncertain[0].to - found.uncertain[0].from < 0.1);
  CHECK(found.points.back().tracks[0].found);
  CHECK_FALSE(found.points.back().tracks[1].found);
}

TEST_CASE("modes of a rotor that is nearly round are followed from rest, however soon they whirl", "[linearised]") {
  // A point on springs 100 and 100 (1 + unequal) along x and y vibrates in planes at rest. In motion a gyroscopic force
  // 2 p acts across its velocity: s^4 + (k_x + k_y + 4 p^2) s^2 + k_x k_y = 0, and whirls are round for
  // p >> 10 unequal / 4.
  for (const double unequal : {1e-5, 1e-9, 0.0}) {
    const double kx = at_rest, ky = at_rest * (1 + unequal);
    const auto solve = [&](double p, int /*count*/) {
      SweepSample sample;
      sample.speed = p;
      sample.modes.all = true;
      sample.modes.M.resize(2, 2);
      sample.modes.M.setIdentity();
      const double half = 0.5 * (kx + ky + 4 * p * p), root = std::sqrt(std::max(0.0, half * half - kx * ky));
      for (const double sign : {-1.0, 1.0}) {
        Mode mode;
        mode.s = Complex(0, std::sqrt(half + sign * root));
        if (p == 0)
          mode.u = sign < 0 ? Eigen::Vector2cd(1, 0) : Eigen::Vector2cd(0, 1);
        else
          mode.u = Eigen::Vector2cd(1, -(kx + mode.s * mode.s) / (2 * p * mode.s));
        sample.modes.modes.push_back(mode);
        sample.modes.whirl.push_back(p == 0 ? 0 : sign);
      }
      return sample;
    };
    for (const auto& [from, to, count] :
         {std::tuple(0.0, 4.0, 5), std::tuple(-4.0, 0.0, 5), std::tuple(-4.0, 4.0, 2)}) {
      const SweptModes found = SpeedSweep(solve, even(from, to, count), 2, {0.1}).run();
      CAPTURE(unequal, from, to);
      CHECK(found.uncertain.empty());
      for (const SweepPoint& point : found.points)
        for (const TrackedMode& track : point.tracks) CHECK(track.found);
      const SweepPoint& last = found.points.back();
      if (to > 0) {
        CHECK(std::abs(last.tracks[0].s) * std::abs(last.tracks[1].s) == Approx(std::sqrt(kx * ky)));
        CHECK(std::abs(std::abs(last.tracks[0].s) - std::abs(last.tracks[1].s)) == Approx(2 * to));
      }
    }
  }
}

TEST_CASE("a mode that does not oscillate in motion is lost from rest, though others mix", "[linearised]") {
  const auto solve = [](double p, int /*count*/) {
    SweepSample sample = oscillators(p, 0);
    if (p > 0) sample.modes.modes.pop_back();
    return sample;
  };
  const SweptModes found = SpeedSweep(solve, even(0, 40, 14), 2, {3}).run();
  REQUIRE(found.uncertain.size() == 1);
  CHECK(found.uncertain[0].lost);
  CHECK(found.uncertain[0].from == 0);
}

TEST_CASE("critical speeds on both sides of rest are found between two values far apart", "[linearised]") {
  // Frequencies 10 at rest: sqrt(100 -+ 0.8 p) = |p|, p^2 +- 0.8 p = 100 on either side.
  const SweptModes found =
      SpeedSweep([](double p, int /*count*/) { return oscillators(p, 0); }, {-30, 29}, 1, {1}).run();
  std::vector<double> speeds;
  for (const CriticalSpeed& each : found.critical) speeds.push_back(each.speed);
  REQUIRE(speeds.size() == 2);
  const double root = std::sqrt(slope * slope / 4 + at_rest);
  CHECK(std::abs(speeds[0]) + std::abs(speeds[1]) == Approx(2 * root).epsilon(1e-8));
  CHECK(speeds[0] * speeds[1] == Approx(-at_rest).epsilon(1e-8));
}

}  // namespace test_mode_tracking
