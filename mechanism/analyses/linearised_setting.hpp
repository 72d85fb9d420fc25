// In which axes small motions about a state are seen, and what may be wrong with the state.
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/solvers/linearised/steadiness.hpp"

namespace bielle::mechanism {

struct LinearisedSetting {
  ModeAxes axes = ModeAxes::inertial;
  std::optional<Steadiness> steadiness;  ///< nothing at rest
  double unbalance = 0;                  ///< at rest: the largest missing force relative to the largest that acts
  std::string unbalanced;                ///< its equation, with the force: "force y at node 'pin'"
};

LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
