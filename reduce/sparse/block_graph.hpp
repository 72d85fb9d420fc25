// The graph of coupled blocks of unknowns of a sparse symmetric matrix: the nodes of a mesh, whose unknowns have the
// same neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

/// Blocks are numbered in the order of their unknowns, which are consecutive.
struct BlockGraph {
  std::vector<std::int64_t> first{0};  ///< unknown of each block, then the number of unknowns
  std::vector<int> starts{0};          ///< lower triangle: block b is coupled with `rows[starts[b] .. starts[b+1])`,
  std::vector<int> rows;               ///< blocks coupled with b, none below b, ascending; b itself is the first

  int size() const { return static_cast<int>(starts.size()) - 1; }
  std::int64_t unknowns() const { return first.back(); }
  std::int64_t weight(int b) const {
    return first[static_cast<std::size_t>(b) + 1] - first[static_cast<std::size_t>(b)];
  }
};

/// Makes the graph of a matrix. @param block_starts  first unknown of each block, then `a.size`; if empty, every
/// unknown is its own block
BlockGraph block_graph(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts);

}  // namespace bielle
