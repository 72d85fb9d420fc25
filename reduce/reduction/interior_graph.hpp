// The graph of the factorised matrix, known before the matrices: points that share a cell, and released directions that
// move some of them.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/fe/node_graph.hpp"
#include "reduce/reduction/ties.hpp"
#include "reduce/sparse/block_graph.hpp"

namespace bielle::reduce {

/// The unknowns of P^T K P, P = [unit vectors of the unknowns `kept`, carried].
struct InteriorUnknowns {
  std::vector<std::int64_t> kept;  ///< unknowns x y z of point 0, of point 1, ..., ascending
  SparseRows carried;              ///< (3 points, c)

  /// Tells whether P has the same pattern.
  bool is_like(const InteriorUnknowns& other) const;
};

/// Makes one block of three unknowns for each point.
BlockGraph point_graph(const NodeGraph& graph);

/// Blocks of P^T K P: points with kept unknowns, then each column of `carried` by itself.
/// @param points  graph of K
BlockGraph interior_graph(const BlockGraph& points, const InteriorUnknowns& interior);

}  // namespace bielle::reduce
