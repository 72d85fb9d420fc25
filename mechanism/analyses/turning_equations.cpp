#include "mechanism/analyses/turning_equations.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/azimuth_equations.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

constexpr int azimuths = 8;  // coefficients have up to three harmonics

/// Exponents s and s + i rate of a slow rotation are nearly the same: harmonics of one motion cannot be told apart.
bool is_negligible(const System& system, const StandingState& about, const TurningPart& part, double rate) {
  if (rate == 0) return true;
  constexpr double share = 1e-6, rounding = 1e-5;
  const LinearisedEquations present = equations_over_turn(system, about.environment, about.state, part, 1).front();
  ModeOptions slowest;
  slowest.count = 3;
  const Modes found = find_modes(present, slowest);
  double fastest = 0;
  for (const Mode& mode : found.modes) fastest = std::max(fastest, std::abs(mode.s));
  if (std::abs(rate) >= share * fastest) return false;
  // Free turning is a double zero, which rounding moves.
  return std::all_of(found.modes.begin(), found.modes.end(), [&](const Mode& mode) {
    return std::abs(mode.s) <= rounding * fastest || std::abs(rate) < share * std::abs(mode.s);
  });
}

}  // namespace

TurningEquations::TurningEquations(const System& system, const StandingState& about, const SteadyRotation& rotation)
    : part(system, about.environment, about.state, *rotation.joint),
      negligible(is_negligible(system, about, part, rotation.rate)),
      periodic(equations_over_turn(system, about.environment, about.state, part, negligible ? 1 : azimuths),
               rotation.rate, model_length(about.state)),
      turning(part.turning_unknowns(system)),
      joint(describe(system.model().members()[*rotation.joint])) {}

LinearisedSetting TurningEquations::setting(const HarmonicModes& modes) const {
  LinearisedSetting setting;
  setting.axes = ModeAxes::turning;
  setting.turning = {joint, periodic.rate(), negligible ? Periodicity::negligible : modes.periodicity, modes.harmonics,
                     modes.change};
  return setting;
}

}  // namespace bielle::mechanism
