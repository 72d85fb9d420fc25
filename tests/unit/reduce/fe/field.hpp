// Values of fields that are given by formulas, at the points of a mesh.
#pragma once

#include <functional>

#include "reduce/mesh/mesh.hpp"

namespace bielle::test {

/// Returns u(x) at all points, stacked in one column.
inline RowMatrix field(const reduce::Mesh& mesh, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& u) {
  RowMatrix result(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) result.block<3, 1>(3 * a, 0) = u(mesh.points.col(a));
  return result;
}

}  // namespace bielle::test
