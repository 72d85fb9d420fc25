// Keys of lines of a circuit.
#pragma once

#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

const KeyTable& orifice_keys();
const KeyTable& laminar_keys();
const KeyTable& check_valve_keys();
const KeyTable& relief_keys();
const KeyTable& counterbalance_keys();
const KeyTable& flow_valve_keys();
const KeyTable& valve_keys();
const KeyTable& servo_valve_keys();
const KeyTable& pipe_keys();
/// Returns the keys `from`, `to` and `ports`, which name the places that a line connects.
std::vector<Key> line_end_keys();

}  // namespace bielle::mechanism
