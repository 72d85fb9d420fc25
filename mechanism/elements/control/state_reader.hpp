// Reads the section `states`: differential equations of the user, and control blocks.
//
//     x:      {rate: "-(x - main.angle)/0.1", start: 0, units: rad}
//     smooth: {filter: main.angle, time_constant: 0.01}      {filter: .., frequency: 20, damping: 0.7}
//     lead:   {transfer_function: {numerator: [1, 2], denominator: [1, 20]}, input: error}
//     plant:  {state_space: {A: .., B: .., C: .., D: ..}, inputs: [..]}
//     seen:   {sampled: main.angle, period: 1e-3}        late: {delayed: main.angle, time: 0.02}
// Every state is a measure with its name, recorded among the measures.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& state_keys();
/// Reads an entry of `states`. @throws InputError
void read_state(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
