// Entries that can be released and activated: the key `active`, and names of such entries.
#pragma once

#include <string>

#include "mechanism/model/activity.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `active` of entries that add forces or constraints without having inertia.
Key activity_key();
/// Reads this key of an entry, after its other keys. @throws InputError for an entry with inertia
void read_activity(const YamlValue& entry, const Entry& own, Model& model);

/// Returns the activity of the joint, element, drive or load that a value names. The other entries must have been read.
/// @throws InputError for an unknown name, one of several entries, or an entry with inertia
const Activity& activity_named_by(const YamlValue& value, Model& model);

}  // namespace bielle::mechanism
