// Named points of foreign matrices, and the residual vectors of loads on them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/matrices/held_matrices.hpp"
#include "reduce/matrices/matrix_basis.hpp"
#include "reduce/matrices/matrix_options.hpp"

namespace bielle::reduce {

/// Displacements at points of the body in terms of the unknowns: of the shapes of the file, or of nodes with three
/// translations.
struct PointMotions {
  Eigen::Matrix3Xd points;                                    ///< (3,p) [m]
  Eigen::SparseMatrix<double, Eigen::RowMajor> displacement;  ///< (3p,n) rows x y z of the first point, of the second
  std::map<int, Eigen::MatrixXi> cells;                       ///< as NodalShapes::cells
};

PointMotions point_motions(const MatrixSet& set);

/// A point with its motion in terms of the unknowns.
struct SetPoint {
  NodePoint request;
  Eigen::Vector3d position;  ///< [m]
  Eigen::MatrixXd rows;      ///< (6,n): displacement and rotation, body axes
};

/// Returns the requested points. A node has its own displacement and rotation, if it has the unknowns for them, or else
/// those of the points around it.
/// @throws InputError about a request: no such node, a place away from all points, two points of one name
std::vector<SetPoint> set_points(const MatrixSet& set, const PointMotions& motions,
                                 const std::vector<NodePoint>& requests);

/// Appends residual vectors for the loads that points request, and for those of inertia. @returns their number
/// @param inertia  (n,k) loads of the body's own inertia; it is no error if nothing is left of them
/// @throws InputError about the request of a point if nothing is left of its loads
Eigen::Index add_residual_vectors(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                                  const std::vector<SetPoint>& points, const Eigen::MatrixXd& inertia,
                                  MatrixBasis& basis);

}  // namespace bielle::reduce
