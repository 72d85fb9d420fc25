// Axes in which small motions about a state are described, and possible errors of the state.
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/solvers/linearised/steadiness.hpp"

namespace bielle::mechanism {

struct LinearisedSetting {
  ModeAxes axes = ModeAxes::inertial;
  std::optional<Steadiness> steadiness;  ///< empty at rest
  double unbalance = 0;                  ///< at rest: largest residual force relative to the largest acting force
  std::string unbalanced;                ///< equation of this residual force: "force y at node 'pin'"
};

LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
