// Orthonormal bases of the spaces that columns span, real and complex, by LAPACK's QR factorisation. Eigen's would be
// compiled here for both types, which takes as long as the rest of the folder.
#pragma once

#include <Eigen/Core>

namespace bielle {

/// Orthonormal columns that span those of A (m,n): (m,r) with the rank r of A, by QR with column pivoting. A diagonal
/// entry of R counts as zero up to min(m,n) times the rounding error of the largest.
Eigen::MatrixXd orthonormal_columns(Eigen::MatrixXd A);
Eigen::MatrixXcd orthonormal_columns(Eigen::MatrixXcd A);

}  // namespace bielle
