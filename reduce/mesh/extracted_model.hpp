// The content of gmsh after it has read a file or meshed a geometry, as plain numbers in metres.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/corners.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// A physical group of gmsh.
struct PhysicalGroup {
  std::string name;           ///< "surface_7", "volume_7" where the file gives a number only
  int dimension = 0;          ///< 2 or 3
  std::vector<int> entities;  ///< surfaces or volumes
};

/// A meshed model. Nodes are numbered from 0 without gaps; nodes that no solid cell uses are left out.
struct ExtractedModel {
  Eigen::Matrix3Xd points;                       ///< [m]
  std::vector<CellBlock> solids;                 ///< cells of each type; numbered block after block
  std::vector<std::size_t> cell_tags;            ///< gmsh's (the file's) number of each solid cell
  std::vector<std::size_t> node_tags;            ///< gmsh's (the file's) number of each node
  std::map<int, std::vector<int>> volumes;       ///< entity -> its cells
  std::map<int, std::vector<Corners>> surfaces;  ///< entity -> its surface cells; nodes of none of the solids: -1
  std::vector<PhysicalGroup> groups;
  std::size_t dropped_nodes = 0;
};

}  // namespace bielle::reduce
