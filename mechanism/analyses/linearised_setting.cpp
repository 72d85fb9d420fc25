#include "mechanism/analyses/linearised_setting.hpp"

namespace bielle::mechanism {

LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state) {
  LinearisedSetting setting;
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
