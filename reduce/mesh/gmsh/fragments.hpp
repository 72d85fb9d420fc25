// Volumes of the geometry that gmsh has open, divided where they meet each other or other surfaces; physical groups
// pass to the parts. All functions call gmsh without translating its exceptions: they belong in session.read().
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bielle::reduce {

using Entity = std::pair<int, int>;  ///< dimension and number in gmsh
using Parts = std::map<Entity, std::vector<Entity>>;

/// A physical group with its number in gmsh.
struct NumberedGroup {
  Entity group;
  std::string name;  ///< empty if it has only a number
  std::vector<int> entities;
};

/// Physical groups of surfaces and volumes.
std::vector<NumberedGroup> numbered_groups();

/// Tells whether all volumes are of the OpenCASCADE kernel, which alone can divide them.
bool is_open_cascade();

/// Divides the volumes at each other and at `tools`, surfaces that are then removed: volumes that touch get common
/// faces.
/// @returns the parts of the volumes and surfaces that were there before; a part of several volumes is their overlap
Parts divide_volumes(const std::vector<Entity>& tools);

/// Replaces the physical groups by these, of which each entity is replaced by its parts; groups without any part left
/// end.
void restore_groups(const std::vector<NumberedGroup>& groups, const Parts& parts_of);

}  // namespace bielle::reduce
