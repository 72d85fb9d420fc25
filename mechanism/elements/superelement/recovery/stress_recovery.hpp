// Stress at nodes of a superelement's mesh as a linear function of its local coordinates, and whose stress it is.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/recovery/recovery_product.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

struct StressRecovery {
  RecoveryMatrix matrix;                     ///< (6 s, n): rows xx yy zz yz xz xy of each node, body axes [Pa]
  std::vector<int> nodes;                    ///< (s) of the mesh
  Eigen::Matrix3Xd points;                   ///< (3, s) where they are, axes of the mesh [m]
  std::vector<Matrix6> compliance;           ///< C^-1 of each material [1/Pa]; empty: the file names none
  std::vector<int> material_of;              ///< (s) of each node
  std::vector<std::string> groups;           ///< names of the volume groups
  std::vector<std::vector<int>> group_rows;  ///< places in `nodes` of each group, ascending

  /// @throws InputError when the superelement keeps no stress, saying how it would
  explicit StressRecovery(const Superelement& body);

  int size() const { return static_cast<int>(nodes.size()); }
  /// The same of one node alone, without groups. @param row  place in `nodes`
  StressRecovery alone(int row) const;
  /// Place in `nodes` of what stands nearest to a point of the mesh [m].
  /// @throws InputError when the point is farther from all of them than the mesh is coarse there
  int nearest(const Vector3& point) const;
  /// Place in `nodes` of a node of the mesh. @throws InputError when its stress is not kept
  int place_of(int node) const;

 private:
  StressRecovery() = default;
};

}  // namespace bielle::mechanism
