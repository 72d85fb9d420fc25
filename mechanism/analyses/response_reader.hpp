// Readers of `inputs` and `outputs` of analyses of small motions.
#pragma once

#include <vector>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the keys `inputs` and `outputs`.
std::vector<Key> response_keys();
/// Reads `inputs: [push, {node: tip, direction: z, quantity: moment}]` of an analysis; at least one.
std::vector<ResponseInput> read_response_inputs(const YamlValue& entry, const Model& model);
/// Reads `outputs: [error, {node: tip, direction: z, quantity: rotation}]` of an analysis; at least one.
std::vector<ResponseOutput> read_response_outputs(const YamlValue& entry, const Model& model);

}  // namespace bielle::mechanism
