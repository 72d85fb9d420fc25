#include "reduce/mesh/mesh.hpp"

#include <stdexcept>

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

const CellBlock& Mesh::solids() const {
  for (const CellBlock& block : blocks)
    if (dimension(block.type) == 3) return block;
  throw std::logic_error("a mesh without solid cells");
}

}  // namespace bielle::reduce
