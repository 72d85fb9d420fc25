#include "mechanism/reading/pid_gains.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

std::vector<Key> pid_gain_keys(const std::string& output, const std::string& input) {
  using namespace keys;
  return {{"kp", number("any"), otherwise("0"), fmt::format("Proportional gain: {} per {}.", output, input)},
          {"ki", number("any"), otherwise("0"), fmt::format("Integral gain: {} per {} and time.", output, input)},
          {"kd", number("any"), otherwise("0"), fmt::format("Derivative gain: {} per rate of the {}.", output, input)},
          {"filter", number("s").non_negative(), otherwise("0"), "Time constant of the derivative; 0 is none."}};
}

PidGains read_pid_gains(const YamlValue& entry) {
  const PidGains gains{entry.at("kp").number(), entry.at("ki").number(), entry.at("kd").number(),
                       entry.at("filter").number()};
  if (gains.proportional == 0 && gains.integral == 0 && gains.derivative == 0)
    entry.fail("a controller needs at least one of the gains kp, ki, kd");
  if (gains.derivative == 0 && gains.filter > 0)
    entry.at("filter").fail("is that of the derivative, which has no gain: give `kd`, too");
  return gains;
}

}  // namespace bielle::mechanism
