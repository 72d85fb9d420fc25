#include "mechanism/analyses/turning_equations.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/azimuth_equations.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/orbit_equations.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr int least_azimuths = 8;  // coefficients about the mean state have up to three harmonics

/// Tells whether a rotation is so slow that the exponents s and s + i rate are nearly the same. The harmonics of one
/// motion cannot be distinguished then.
bool is_negligible(const System& system, const StandingState& about, const TurningPart& part, double rate) {
  if (rate == 0) return true;
  constexpr double share = 1e-6, rounding = 1e-5;
  const LinearisedEquations present = equations_over_turn(system, about.environment, about.state, part, 1).front();
  if (std::abs(rate) >= share * fastest_rate(present)) return false;  // no motion is faster
  ModeOptions slowest;
  slowest.count = 3;
  const Modes found = find_modes(present, slowest);
  double fastest = 0;
  for (const Mode& mode : found.modes) fastest = std::max(fastest, std::abs(mode.s));
  if (std::abs(rate) >= share * fastest) return false;
  // A part that turns freely has a double zero exponent, which rounding errors split.
  return std::all_of(found.modes.begin(), found.modes.end(), [&](const Mode& mode) {
    return std::abs(mode.s) <= rounding * fastest || std::abs(rate) < share * std::abs(mode.s);
  });
}

std::optional<PeriodicOrbit> orbit_of(const System& system, const StandingState& about, const TurningPart& part,
                                      const SteadyRotation& rotation, bool negligible) {
  if (negligible || rotation.mean) return std::nullopt;
  return find_periodic_orbit(system, about.environment, about.state, part, rotation.rate);
}

std::vector<LinearisedEquations> equations_of(std::vector<Azimuth> azimuths) {
  std::vector<LinearisedEquations> equations;
  for (Azimuth& each : azimuths) equations.push_back(std::move(each.equations));
  return equations;
}

PeriodicEquations periodic_equations(const System& system, const StandingState& about, const TurningEquations& turning,
                                     double rate) {
  int count = turning.negligible ? 1 : least_azimuths;
  if (turning.orbit) count = std::max(count, 2 * (turning.orbit->deviation.harmonics + 2));
  // Products of the motion's harmonics have higher ones, whose number is not known.
  constexpr int usual_most = 64;
  const int most = std::max(usual_most, 4 * count);
  for (;; count *= 2) {
    PeriodicEquations periodic(equations_of(turning.azimuths(system, about, count)), rate, model_length(about.state));
    if (turning.negligible || periodic.resolved()) return periodic;
    if (!turning.orbit || 2 * count > most)
      throw ComputationError("the equations change too rapidly with the azimuth of the turning part");
  }
}

std::optional<PeriodicEquations> mean_equations(const System& system, const StandingState& about,
                                                const TurningEquations& turning, double rate) {
  if (!turning.orbit) return std::nullopt;
  PeriodicEquations mean(equations_over_turn(system, about.environment, about.state, turning.part, least_azimuths),
                         rate, model_length(about.state));
  return mean.resolved() ? std::optional(std::move(mean)) : std::nullopt;
}

}  // namespace

TurningEquations::TurningEquations(const System& system, const StandingState& about, const SteadyRotation& rotation)
    : part(system, about.environment, about.state, *rotation.joint),
      negligible(is_negligible(system, about, part, rotation.rate)),
      orbit(orbit_of(system, about, part, rotation, negligible)),
      periodic(periodic_equations(system, about, *this, rotation.rate)),
      mean_periodic(mean_equations(system, about, *this, rotation.rate)),
      turning(part.turning_unknowns(system)),
      joint(describe(system.model().members()[*rotation.joint])),
      moved(orbit ? system.model().node(orbit->moved).name : ""),
      mean(rotation.mean) {}

std::vector<Azimuth> TurningEquations::azimuths(const System& system, const StandingState& about, int count) const {
  std::vector<Azimuth> of_mean = azimuths_over_turn(system, about.environment, about.state, part, count);
  if (!orbit) return of_mean;
  const OrbitEquations equations(system, about.environment, part, std::move(of_mean));
  std::vector<Azimuth> list;
  for (int k = 0; k < count; ++k) list.push_back(equations.linearised(k, orbit->deviation));
  return list;
}

LinearisedSetting TurningEquations::setting(const HarmonicModes& modes) const {
  LinearisedSetting setting;
  setting.axes = ModeAxes::turning;
  LinearisedSetting::Turning turned{
      joint,           periodic.rate(), negligible ? Periodicity::negligible : modes.periodicity,
      modes.harmonics, modes.change,    mean};
  if (orbit) {
    turned.displacement = orbit->displacement;
    turned.rotation = orbit->rotation;
    turned.moved = moved;
    turned.orbit_harmonics = orbit->deviation.harmonics;
    turned.unresolved = modes.unresolved;
  }
  setting.turning = turned;
  return setting;
}

}  // namespace bielle::mechanism
