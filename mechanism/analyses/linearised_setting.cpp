#include "mechanism/analyses/linearised_setting.hpp"

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {

LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state,
                                     const std::optional<SteadyRotation>& rotation) {
  LinearisedSetting setting;
  if (rotation && !rotation->omega.isZero(0)) {
    constexpr double rounding = 1e-6;
    const LeavingRotation leaving = leaving_rotation(system, environment, state, rotation->omega, rotation->through);
    if (leaving.acceleration > rounding) {
      setting.leaving = leaving.acceleration * rotation->omega.squaredNorm() * model_length(state);
      setting.leaving_node = system.model().node(leaving.node).name;
    }
  }
  setting.steadiness = find_steadiness(system, environment, state);
  if (setting.steadiness) {
    setting.axes = setting.steadiness->axes();
    return setting;
  }
  int equation = -1;
  setting.unbalance = unbalance(system, environment, state, equation);
  if (equation >= 0) setting.unbalanced = system.equation_name(equation);
  return setting;
}

}  // namespace bielle::mechanism
