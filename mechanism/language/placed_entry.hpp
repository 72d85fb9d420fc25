// Entries of a part that is moved, turned or mirrored: axes that they would take from the inertial ones are written
// explicitly.
#pragma once

#include <functional>
#include <string>

#include "mechanism/language/scope.hpp"
#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Returns the frame of a node of the model.
using NodeFrame = std::function<Frame(const YamlNode& name, const std::string& path)>;

/// Refuses an entry that has no meaning in a part that is turned or mirrored: a node with directions that are held
/// along inertial axes, or an entry that cannot be mirrored.
/// @param section  "nodes", "elements", ..
/// @param entry    as the part writes it
void check_placed(const YamlNode& entry, const std::string& section, const Scope& scope, const std::string& path);

/// Adds the axes of a joint, the orientation of a beam, and the origin of the points of a curve, that would follow from
/// the inertial axes.
/// @param placed  the entry in the model
/// @param table   table of the entry
Tree with_explicit_axes(const Tree& placed, const KeyTable& table, const Scope& scope, const NodeFrame& node_frame,
                        const std::string& path);

}  // namespace bielle::mechanism
