#include "reduce/mesh/solid_cells.hpp"

#include "reduce/common/sort_unique.hpp"

namespace bielle::reduce {

SolidCells::SolidCells(const Mesh& mesh) : mesh_(&mesh) {
  for (std::size_t k = 0; k < mesh.blocks.size(); ++k) {
    const CellBlock& block = mesh.blocks[k];
    if (dimension(block.type) != 3) continue;
    const int count = static_cast<int>(block.nodes.cols());
    ranges_.push_back({block.type, vertex_count(block.type), size_, count, k});
    size_ += count;
  }
}

const SolidCells::Range& SolidCells::range_of(int cell) const {
  std::size_t k = ranges_.size() - 1;
  while (ranges_[k].first > cell) --k;
  return ranges_[k];
}

SolidCells::Nodes SolidCells::first_nodes(const Range& range, int cell, int count) const {
  return {nodes_of(range).col(cell - range.first).data(), count};
}

SolidCells::Nodes SolidCells::nodes(int cell) const {
  const Range& range = range_of(cell);
  return first_nodes(range, cell, static_cast<int>(nodes_of(range).rows()));
}

SolidCells::Nodes SolidCells::vertices(int cell) const {
  const Range& range = range_of(cell);
  return first_nodes(range, cell, range.vertices);
}

std::vector<int> SolidCells::members(const Group& group) const {
  std::vector<int> cells;
  for (const GroupPart& part : group.parts)
    for (const Range& range : ranges_)
      if (range.type == part.type)
        for (const int cell : part.cells) cells.push_back(range.first + cell);
  sort_unique(cells);
  return cells;
}

Group SolidCells::group_of(std::vector<int> cells) const {
  sort_unique(cells);
  Group group{3};
  for (const Range& range : ranges_) {
    GroupPart part{range.type, {}};
    for (const int cell : cells)
      if (cell >= range.first && cell < range.first + range.count) part.cells.push_back(cell - range.first);
    if (!part.cells.empty()) group.parts.push_back(std::move(part));
  }
  for (const int cell : cells) {
    const Nodes of_cell = nodes(cell);
    group.nodes.insert(group.nodes.end(), of_cell.begin(), of_cell.end());
  }
  sort_unique(group.nodes);
  return group;
}

std::vector<CellBlock> SolidCells::blocks_of(const std::vector<int>& cells, const std::vector<int>& number) const {
  std::vector<CellBlock> blocks;
  for (const GroupPart& part : group_of(cells).parts) {
    CellBlock block{part.type, mesh_->block(part.type)->nodes(Eigen::all, part.cells)};
    for (int& node : block.nodes.reshaped()) node = number[node];
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace bielle::reduce
