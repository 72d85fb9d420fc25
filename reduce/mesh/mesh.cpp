#include "reduce/mesh/mesh.hpp"

#include <stdexcept>

namespace bielle::reduce {

int node_count(CellType type) {
  switch (type) {
    case CellType::tri3:
      return 3;
    case CellType::tet4:
      return 4;
    case CellType::tri6:
      return 6;
    case CellType::tet10:
      return 10;
  }
  return 0;
}

int dimension(CellType type) { return type == CellType::tet4 || type == CellType::tet10 ? 3 : 2; }

std::string cell_name(CellType type) {
  switch (type) {
    case CellType::tri3:
      return "tri3";
    case CellType::tet4:
      return "tet4";
    case CellType::tri6:
      return "tri6";
    case CellType::tet10:
      return "tet10";
  }
  return "";
}

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
