// The graph of what is factorised, known before the matrices are: points that share a cell, and released directions
// that move some of them.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/fe/node_graph.hpp"
#include "reduce/reduction/ties.hpp"
#include "reduce/sparse/block_graph.hpp"

namespace bielle::reduce {

/// The unknowns of P^T K P, P = [unit vectors of the unknowns `kept`, carried].
struct InsideUnknowns {
  std::vector<std::int64_t> kept;  ///< of x y z of point 0, of point 1, ..., ascending
  SparseRows carried;              ///< (3 points, c)

  /// Whether P has the same pattern.
  bool is_like(const InsideUnknowns& other) const;
};

/// One block of three unknowns for each point.
BlockGraph point_graph(const NodeGraph& graph);

/// Blocks of P^T K P: points of which unknowns are kept, then each column of `carried` by itself.
/// @param points  that of K
BlockGraph inside_graph(const BlockGraph& points, const InsideUnknowns& inside);

}  // namespace bielle::reduce
