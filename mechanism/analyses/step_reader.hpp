// Durations and steps of analyses.
#pragma once

#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Refuses a step longer than the duration, and more steps than anyone waits for. @param step  [s] > 0
/// @param key  of the entry, where the step comes from
void check_step(const YamlValue& entry, const std::string& key, double step, double duration);

}  // namespace bielle::mechanism
