// A solid mesh in metres, imported from gmsh or from another format.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// All cells of one type: column e holds the node numbers (from 0) of cell e.
struct CellBlock {
  CellType type;
  Eigen::MatrixXi nodes;  ///< node_count x cells
};

/// Cells of one block that belong to a group.
struct GroupPart {
  CellType type;
  std::vector<int> cells;  ///< columns of the block of that type
};

/// A named surface (dimension 2) or volume (dimension 3), which is a physical group; or nodes alone (dimension 0).
struct Group {
  int dimension = 0;
  std::vector<GroupPart> parts = {};
  std::vector<int> nodes = {};       ///< nodes of all its cells, ascending, each once
  std::vector<double> weights = {};  ///< weights of the nodes if these are alone
};

/// Points and cells in SI. Each CellType occurs in at most one block.
///
/// Surface cells are the faces of solid cells that belong to a group, each once, with the face's outward orientation
/// (for a face between two solids: outward of the one with the lower number).
struct Mesh {
  Eigen::Matrix3Xd points;  ///< [m]
  std::vector<CellBlock> blocks;
  std::map<std::string, Group> groups;

  const CellBlock* block(CellType type) const;  ///< nullptr when there are none
  Eigen::Index point_count() const { return points.cols(); }
  Eigen::Index solid_count() const;  ///< number of solid cells
};

}  // namespace bielle::reduce
