// The energy balance tells the missing energy relative to the energy stored, and to the energy that flows through.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/session/energy_balance.hpp"

using namespace bielle::mechanism;

namespace {

Energy energy(double kinetic, double input = 0, double dissipation = 0) {
  Energy result;
  result.kinetic = kinetic;
  result.input = input;
  result.dissipation = dissipation;
  return result;
}

/// Returns the relative error as in a summary.
double relative_error(const EnergyBalance& energy_balance) {
  return energy_balance.largest_error() / std::max(energy_balance.largest(), 0.1 * energy_balance.largest_turnover());
}

}  // namespace

TEST_CASE("small errors of a steady machine do not add up to a large one, and a large one does not drown in the flow") {
  // 10 W flow through a machine that stores 1 J, for 1000 s; 0.1 mJ per second are missing, and at half time half a
  // joule.
  for (const double lost : {0.0, 0.5}) {
    EnergyBalance energy_balance;
    energy_balance.start(0, energy(1, 10, 10));
    for (int k = 1; k <= 100000; ++k) {
      const double t = 0.01 * k;
      energy_balance.advance(t, energy(1 - 1e-4 * t - (t > 500 ? lost : 0), 10, 10));
    }
    CHECK(energy_balance.through() == Approx(10000));
    CHECK(energy_balance.balance() == Approx(-0.1 - lost));
    CHECK(std::abs(energy_balance.balance()) / energy_balance.through() < 1e-4);
    if (lost == 0) CHECK(relative_error(energy_balance) == Approx(1e-5).epsilon(0.2));  // a turn takes 0.1 s
    if (lost > 0) CHECK(relative_error(energy_balance) == Approx(0.5).epsilon(0.1));
  }
}

TEST_CASE("a motion through which nothing flows is one stretch, whatever its energy does") {
  EnergyBalance energy_balance;
  energy_balance.start(0, energy(2));
  for (int k = 1; k <= 100; ++k) energy_balance.advance(0.1 * k, energy(2 + 0.01 * k));
  CHECK(energy_balance.through() == 0);
  CHECK(energy_balance.largest() == Approx(3));
  CHECK(energy_balance.largest_error() == Approx(1));
  CHECK(relative_error(energy_balance) == Approx(1.0 / 3));
}

TEST_CASE("what goes in and comes out again has flowed through, in steps and in jumps") {
  EnergyBalance energy_balance;
  energy_balance.start(0, energy(0));
  // Power sin(t): the stored energy is 1 - cos(t), and each turn moves 4 J.
  constexpr int steps = 20000;
  for (int k = 1; k <= steps; ++k) {
    const double t = 2 * M_PI * k / steps;
    energy_balance.advance(t, energy(1 - std::cos(t), std::sin(t)));
  }
  CHECK(energy_balance.through() == Approx(4).epsilon(1e-6));
  CHECK(std::abs(energy_balance.balance()) < 1e-6);
  energy_balance.jump(energy(0), energy(0.5), 1.5);  // a drive that jumps: 1.5 J of work, 0.5 J stored
  CHECK(energy_balance.through() == Approx(5.5).epsilon(1e-6));
  CHECK(std::abs(energy_balance.balance()) < 1e-6);
}

TEST_CASE("what the scheme's own damping takes is no error") {
  EnergyBalance energy_balance;
  energy_balance.start(0, energy(1));
  for (int k = 1; k <= 100; ++k) energy_balance.advance(0.1 * k, energy(1 - 0.005 * k), 0.005 * k);
  CHECK(energy_balance.balance() == Approx(-0.5));
  CHECK(energy_balance.largest_error() < 1e-12);
}

TEST_CASE("the energy balance goes on from a checkpoint as it was") {
  EnergyBalance energy_balance;
  energy_balance.start(0, energy(1, 1, 1));
  for (int k = 1; k <= 30; ++k) energy_balance.advance(0.1 * k, energy(1 + 0.1 * std::sin(k), 1, 0.9), 0.001 * k);
  Archive written;
  energy_balance.exchange(written);
  Archive read(written.values());
  EnergyBalance others;
  others.exchange(read);
  for (EnergyBalance* both : {&energy_balance, &others})
    for (int k = 31; k <= 60; ++k) both->advance(0.1 * k, energy(1 + 0.1 * std::sin(k), 1, 0.9), 0.001 * k);
  CHECK(others.balance() == energy_balance.balance());
  CHECK(others.through() == energy_balance.through());
  CHECK(others.largest_error() == energy_balance.largest_error());
  CHECK(others.largest_turnover() == energy_balance.largest_turnover());
}
