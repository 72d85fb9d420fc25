// Stress at nodes of a superelement's mesh as a linear function of its local coordinates, with the nodes and their
// materials.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/recovery/recovery_product.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

struct StressRecovery {
  RecoveryMatrix matrix;                     ///< (6 s, n): rows xx yy zz yz xz xy of each node, body axes [Pa]
  std::vector<int> nodes;                    ///< (s) nodes of the mesh
  Eigen::Matrix3Xd points;                   ///< (3, s) their positions, axes of the mesh [m]
  std::vector<Matrix6> compliance;           ///< C^-1 of each material [1/Pa]; empty: the file contains none
  std::vector<int> material_of;              ///< (s) for each node
  std::vector<std::string> groups;           ///< names of the volume groups
  std::vector<std::vector<int>> group_rows;  ///< indices in `nodes` for each group, ascending

  /// @throws InputError if the superelement file contains no stress; the message describes how to make one that does
  explicit StressRecovery(const Superelement& body);

  int size() const { return static_cast<int>(nodes.size()); }
  /// Returns the recovery of one node only, without groups. @param row  index in `nodes`
  StressRecovery alone(int row) const;
  /// Returns the index in `nodes` of the node nearest to a point of the mesh [m].
  /// @throws InputError if the distance of the point from all of them exceeds the mesh size there
  int nearest(const Vector3& point) const;
  /// Returns the index in `nodes` of a node of the mesh. @throws InputError if its stress is not in the file
  int place_of(int node) const;

 private:
  StressRecovery() = default;
};

}  // namespace bielle::mechanism
