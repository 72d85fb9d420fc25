// Checks of durations and steps of analyses.
#pragma once

#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Rejects a step that is longer than the duration, or results in too many steps. @param step  [s] > 0
/// @param key  key of the entry that the step was read from
void check_step(const YamlValue& entry, const std::string& key, double step, double duration);

}  // namespace bielle::mechanism
