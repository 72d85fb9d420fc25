// The data of one rank: a part of the mesh, and the relation of its points to the unknowns of the interior.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/files/packing.hpp"
#include "reduce/fe/integration.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Cells with their points, numbered anew, and their materials.
struct MeshShare {
  Eigen::Matrix3Xd points;        ///< [m]
  std::vector<CellBlock> blocks;  ///< one for each type of cells, then of coated faces
  std::vector<int> material_of;   ///< of each cell, block after block
  std::vector<Material> materials;
  Integration integration = Integration::standard;
  std::vector<Coating> coatings;  ///< faces that are not in another share, too
  bool lumped = false;
};

void exchange(Packing& packing, MeshShare& share);

/// u = P z on the points of a share: row k of u is the unknown `numbers[k]` of z, or (-1) sum of `weights` times
/// unknowns over `starts[k] .. starts[k+1]`.
struct InteriorShare {
  std::vector<int> numbers;  ///< (3 points)
  std::vector<int> starts;   ///< (3 points + 1)
  std::vector<int> unknowns;
  std::vector<double> weights;
};

void exchange(Packing& packing, InteriorShare& share);

/// First unknown of each block, then the number of unknowns; the unknowns of a point are consecutive.
struct BlockStarts {
  std::vector<int> starts;
};

void exchange(Packing& packing, BlockStarts& blocks);

/// Statistics of a distributed factorisation.
struct SharedFactorStatistics {
  double nonzeros = 0, flops = 0, estimated_MB = 0;  ///< sums over all ranks
  double analysis_seconds = 0, factorisation_seconds = 0;
  std::int64_t negative_pivots = 0;
};

}  // namespace bielle::reduce
