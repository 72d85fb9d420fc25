// Distribution of cells among ranks: the body's cells are halved, by their centroids, along its longest direction, then
// the halves likewise (recursive coordinate bisection). Rank 0, on whose machine bielle-reduce keeps the fields, gets
// fewer cells.
#pragma once

#include <vector>

#include "reduce/distributed/shares.hpp"
#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// One part of a solid.
struct SolidPart {
  std::vector<int> points;  ///< number in the solid of each of its points, ascending
  MeshShare share;
};

/// Cells of each part: the first part gets a third as many as each of the others, which differ by a few cells.
/// @param parts  >= 1; there may be more than cells
std::vector<std::vector<int>> divided_cells(const Solid& solid, int parts);

/// Returns, for each coating, the (first) cell of each of its faces.
using CoatedCells = std::vector<std::vector<int>>;
CoatedCells coated_cells(const Solid& solid);

/// @param cells   ascending
/// @param coated  coated_cells of the solid
SolidPart part_of(const Solid& solid, const std::vector<int>& cells, const CoatedCells& coated);

}  // namespace bielle::reduce
