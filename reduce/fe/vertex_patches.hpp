// Patches of cells around the vertices of a mesh, over which a stress is fitted. Internal to reduce/fe.
#pragma once

#include <vector>

#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// Cells of one material around each of its vertices.
struct Surroundings {
  std::vector<int> vertices;            // points
  std::vector<int> number;              // number in `vertices` of each point; -1: no vertex of the material
  std::vector<std::vector<int>> cells;  // around each vertex
};

/// @param material  number in `solid.materials`
Surroundings surroundings(const Solid& solid, int material);

/// Returns the cells around a vertex, then those around their vertices, and so on, until there are `least` cells or no
/// more.
/// @param vertex  number in `around.vertices`; @param least  cells
std::vector<int> patch_of(const Solid& solid, const Surroundings& around, std::size_t vertex, std::size_t least);

}  // namespace bielle::reduce
