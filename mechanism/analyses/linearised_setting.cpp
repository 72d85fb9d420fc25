#include "mechanism/analyses/linearised_setting.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state,
                                     const std::optional<SteadyRotation>& rotation) {
  LinearisedSetting setting;
  setting.steadiness = find_steadiness(system, environment, state);
  if (setting.steadiness) {
    setting.axes = setting.steadiness->axes();
    if (rotation && setting.steadiness->steady())
      if (const auto force = standing_force(system, environment, state, rotation->omega, rotation->through))
        setting.standing = fmt::format("{:.3g} {} at node '{}'", force->size, force->moment ? "N m" : "N",
                                       system.model().node(force->node).name);
    return setting;
  }
  int equation = -1;
  setting.unbalance = unbalance(system, environment, state, equation);
  if (equation >= 0) setting.unbalanced = system.equation_name(equation);
  return setting;
}

}  // namespace bielle::mechanism
