// Ties of the points that the body file names to the mesh.
//
// On a surface a point follows the mean motion, as the node of an average tie does (ties.hpp), but does not constrain
// it. Otherwise it follows the nodes around it (reduce/superelement/point_weights.hpp). In both cases its motion is W
// u, and a load on it acts on the nodes by W^T.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/reduction/ties.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

struct TiedPoint {
  PointRequest request;
  Eigen::Vector3d position;  ///< [m]
  SparseRows spread;         ///< (3 points, 6): W^T, body axes
};

/// @param body  its name, for messages
/// @throws InputError about the request: a surface that does not exist in the mesh, a position far from the mesh or
/// from
///         the surface, two points of the same name
std::vector<TiedPoint> tie_points(const Solid& solid, const std::vector<PointRequest>& requests,
                                  const std::string& body);

/// Returns the motions of the points in terms of the coordinates. @param shapes  T (3 points, n)
std::map<std::string, NamedPoint> named_points(const std::vector<TiedPoint>& points, const RowMatrix& shapes);

}  // namespace bielle::reduce
