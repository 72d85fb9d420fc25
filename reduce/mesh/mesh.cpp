#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

const CellBlock* Mesh::block(CellType type) const {
  for (const CellBlock& block : blocks)
    if (block.type == type) return &block;
  return nullptr;
}

Eigen::Index Mesh::solid_count() const {
  Eigen::Index count = 0;
  for (const CellBlock& block : blocks)
    if (dimension(block.type) == 3) count += block.nodes.cols();
  return count;
}

}  // namespace bielle::reduce
