// Tables of the keys of drives, with units by the kind of coordinate.
#pragma once

#include "mechanism/joints/actions/joint_action_keys.hpp"

namespace bielle::mechanism {

/// Returns the table of a drive. The kind of its coordinate determines the unit of `limit`.
const KeyTable& drive_keys(Moves moves);
/// Returns the table of `pid`, with units by the kind of coordinate.
const KeyTable& pid_keys(Moves moves);
/// Returns the table of `motor`.
const KeyTable& motor_keys();
/// Returns the table of `release`.
const KeyTable& release_keys();

}  // namespace bielle::mechanism
