// Reads sampled blocks in the section `states`.
//
//     seen:   {sampled: main.angle, period: 1e-3, quantum: 1e-4}
//     u:      {sampled: "target - seen", period: 1e-3, pid: {kp: 40, ki: 10}, limit: [-5, 5]}
//     lead:   {sampled: u, period: 1e-3, transfer_function: {numerator: [1, -0.5], denominator: [1, -0.9]}}
//     plant:  {sampled: [u, seen], period: 1e-3, state_space: {A: .., B: .., C: .., D: ..}}
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

Key sampled_key();
const KeyTable& sampled_keys();
/// Returns the keys of transfer functions and state spaces, which continuous and sampled blocks share.
Key transfer_function_key();
Key state_space_key();
/// @param entry  entry with the key `sampled`, bound to sampled_keys. @throws InputError
void read_sampled(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
