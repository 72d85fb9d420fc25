// The difference between the stress of a mesh and that of the body: the estimate of Zienkiewicz and Zhu.
//
// A smoother stress s* is recovered from that of the cells, s_h: around each vertex a polynomial (linear for cells
// of order 1, quadratic for those of order 2) is fitted to s_h at the sampling points of the cells there, of one
// material; inside a cell s* is the mean of its vertices' polynomials by the functions of order 1. The estimate of the
// error in the energy norm is
//     |e|^2 = int (s* - s_h) : C^-1 : (s* - s_h) dV,   relative: eta = |e| / sqrt(|s_h|^2 + |e|^2).
// For an eigenmode it is also the error of the frequency, which a mesh raises: f_h / f = 1 / sqrt(1 - eta^2). At
// singular places (re-entrant corners, rims of rigid ties) stress has no limit, and the estimate is large. Reference:
// O. C. Zienkiewicz, J. Z. Zhu, IJNME 33 (1992) 1331 and 1365.
#pragma once

#include "reduce/fe/solid.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

struct MeshError {
  Eigen::VectorXd relative;  ///< (k) eta of each field, 0..1; 0 for a field without stress
  /// Centroid of the cell with the largest error per volume, all fields scaled to unit energy [m].
  Eigen::Vector3d worst_place = Eigen::Vector3d::Zero();
};

/// @param fields  (3 points, k) displacements
MeshError estimate_mesh_error(const Solid& solid, const RowMatrix& fields, int threads = 1);

}  // namespace bielle::reduce
