// Supernodes of a Cholesky factor: columns that follow each other and have the same rows below, found on a graph of
// blocks in a given order without the numbers.
//
// Columns of one structure are a fundamental supernode. Small ones are merged with those above them, where few zeros
// come to be stored as numbers: dense products are the faster the larger they are.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/spectral/block_graph.hpp"

namespace bielle {

/// As SupernodalFactor, which it can be seen as.
struct Supernodes {
  std::vector<std::int64_t> columns, row_starts, value_starts, rows, order;
  std::int64_t nonzeros = 0;  ///< of L, those that are stored and zero left out
  double flops = 0;           ///< sum of squares of the numbers in each column of L
};

/// @param order  the blocks as they are eliminated
/// @param merged  whether small supernodes are merged; fundamental ones otherwise
Supernodes find_supernodes(const BlockGraph& graph, const std::vector<int>& order, bool merged = true);

}  // namespace bielle
