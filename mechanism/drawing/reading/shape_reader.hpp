// Reader of `shape`: the shapes by which a node or a body is drawn. They never enter the equations.
#pragma once

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `shape`, for tables of keys.
Key shape_key();

/// Reads a shape, or a list of shapes, in the axes of a node:
// clang-format off
///   {box: [a, b, c] | sphere: r | cylinder: [r, length] | tube: [outer, inner, length] | cone: [below, above, length] |
///    ring: [radius, section] | stl: FILE, scale: | step: FILE, position: [..], orientation key, colour:,
///    opacity:}
// clang-format on
/// z is the axis of rotational symmetry, if there is one; `position` is the middle of the axis, or the origin of the
/// file. @throws InputError
void read_shapes(const YamlValue& value, const Entry& entry, int node, Model& model);

/// Draws a solid that has already been read, with the same shapes; a solid that is cut out has the role `cut`.
/// @param solid  bound to its keys @param offset  position of the solid's origin in the axes of the node [m]
void draw_solid(const YamlValue& solid, const Entry& entry, int node, const Vector3& offset, Model& model);

}  // namespace bielle::mechanism
