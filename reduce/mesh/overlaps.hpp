// Checks that the cells of a mesh do not occupy the same place. Messages name the elements and their places.
#pragma once

#include <string>
#include <vector>

#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Each cell must have corners that no other cell has, in whatever order.
/// @param cell_tags  numbers of the cells in the user's file; may be empty (cells are then numbered from 1)
/// @throws InputError: number of repeated cells, the first pair by numbers and place
void check_repeated_cells(const Mesh& mesh, const std::vector<std::size_t>& cell_tags);

/// The cells of a common face must lie on its two sides. The cells must not be inverted.
/// @param cell_tags  as above
/// @throws InputError: number of faces, the first pair of cells by numbers and place
void check_sides_of_faces(const Mesh& mesh, const FaceTable& faces, const std::vector<std::size_t>& cell_tags);

/// Returns a sentence if cells lie on those of another piece, which has nodes of its own at the same places, or if the
/// centroid of a cell lies inside a cell of another piece (at most 1000 centroids are looked up); else empty.
/// @param piece_of  number of each cell's piece
/// @param node_pairs  pairs of nodes at the same place
/// @param cell_tags  as above
std::string overlap_of_pieces(const Mesh& mesh, const std::vector<int>& piece_of,
                              const std::vector<std::pair<int, int>>& node_pairs,
                              const std::vector<std::size_t>& cell_tags);

}  // namespace bielle::reduce
