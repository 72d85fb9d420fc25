// Tables of the keys of drives, with units by the kind of coordinate.
#pragma once

#include "mechanism/joints/actions/joint_action_keys.hpp"

namespace bielle::mechanism {

/// Returns the table of a drive of a coordinate of some kind, which differs in the unit of `limit`.
const KeyTable& drive_keys(Moves moves);
/// Returns the table of `pid`, likewise.
const KeyTable& pid_keys(Moves moves);
/// Returns the table of `motor`.
const KeyTable& motor_keys();
/// Returns the table of `release`.
const KeyTable& release_keys();

}  // namespace bielle::mechanism
