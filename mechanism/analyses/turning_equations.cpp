#include "mechanism/analyses/turning_equations.hpp"

#include "mechanism/solvers/linearised/azimuth_equations.hpp"

namespace bielle::mechanism {
namespace {

constexpr int azimuths = 8;  // coefficients have up to three harmonics

}  // namespace

TurningEquations::TurningEquations(const System& system, const StandingState& about, const SteadyRotation& rotation)
    : part(system, about.environment, about.state, *rotation.joint),
      periodic(equations_over_turn(system, about.environment, about.state, part, azimuths), rotation.rate),
      turning(part.turning_unknowns(system)),
      joint(describe(system.model().members()[*rotation.joint])) {}

LinearisedSetting TurningEquations::setting(const HarmonicModes& modes) const {
  LinearisedSetting setting;
  setting.axes = ModeAxes::turning;
  setting.turning = {joint, periodic.rate(), modes.periodicity, modes.harmonics, modes.change};
  return setting;
}

}  // namespace bielle::mechanism
