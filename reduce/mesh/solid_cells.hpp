// The solid cells of a mesh, of one type or of several, under one numbering.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// The solid cells of a mesh, numbered from 0: those of its first block of solid cells, then those of the next. It
/// refers to the mesh, to which blocks of surface cells may be added behind.
class SolidCells {
 public:
  using Nodes = Eigen::Map<const Eigen::VectorXi>;

  /// The cells of one type: numbers `first` and following.
  struct Range {
    CellType type;
    int vertices, first, count;
    std::size_t place;  ///< in `Mesh::blocks`
  };

  explicit SolidCells(const Mesh& mesh);

  int size() const { return size_; }
  const std::vector<Range>& ranges() const { return ranges_; }
  const Eigen::MatrixXi& nodes_of(const Range& range) const { return mesh_->blocks[range.place].nodes; }

  CellType type(int cell) const { return range_of(cell).type; }
  Nodes nodes(int cell) const;     ///< all nodes of a cell
  Nodes vertices(int cell) const;  ///< its first ones, at its corners
  Eigen::Matrix3Xd points(int cell) const { return mesh_->points(Eigen::all, nodes(cell)); }            ///< [m]
  Eigen::Matrix3Xd corner_points(int cell) const { return mesh_->points(Eigen::all, vertices(cell)); }  ///< [m]

  /// Numbers of the cells of a volume group, ascending.
  std::vector<int> members(const Group& group) const;
  /// Returns a volume group of some cells.
  Group group_of(std::vector<int> cells) const;
  /// Blocks of some cells alone, in the order of their numbers. @param number  new number of each node
  std::vector<CellBlock> blocks_of(const std::vector<int>& cells, const std::vector<int>& number) const;

 private:
  const Range& range_of(int cell) const;
  Nodes first_nodes(const Range& range, int cell, int count) const;
  const Mesh* mesh_;
  std::vector<Range> ranges_;
  int size_ = 0;
};

}  // namespace bielle::reduce
