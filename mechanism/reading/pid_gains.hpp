// Gains of PID controllers, of drives and of sampled states:   u = kp e + ki int e + kd de/dt.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct PidGains {
  double proportional = 0;  ///< kp [output/input]
  double integral = 0;      ///< ki [output/(input s)]
  double derivative = 0;    ///< kd [output s/input]
  double filter = 0;        ///< time constant of the filter of the derivative [s] >= 0; 0: none
};

/// Returns the keys `kp`, `ki`, `kd` and `filter`.
/// @param output  the controller's output in words, "torque or force" @param input  its input in words, "error"
std::vector<Key> pid_gain_keys(const std::string& output, const std::string& input);
/// Reads these keys. @throws InputError if all gains are zero, or if the filter is that of no derivative
PidGains read_pid_gains(const YamlValue& entry);

}  // namespace bielle::mechanism
