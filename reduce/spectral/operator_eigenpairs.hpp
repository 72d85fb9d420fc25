// Eigenpairs of largest magnitude of an unsymmetric linear operator: by ARPACK's implicitly restarted Arnoldi method,
// or for a small operator by dense algebra (LAPACK's geev).
//
// The operator is given by its product with a vector; it may be a shift-inverted pencil, for instance. All copies of a
// multiple eigenvalue are found that have eigenvectors of their own. Reference: R. B. Lehoucq, D. C. Sorensen, C. Yang,
// ARPACK Users' Guide, SIAM 1998.
#pragma once

#include <complex>
#include <functional>

#include <Eigen/Core>

namespace bielle {

/// y = T x for vectors of a given size. @tparam Scalar double or std::complex<double>
template <class Scalar>
struct LinearOperator {
  using Vector = Eigen::Vector<Scalar, Eigen::Dynamic>;
  Eigen::Index size = 0;
  std::function<Vector(const Vector& x)> apply;
};

struct OperatorEigenOptions {
  Eigen::Index dense = 300;  ///< up to this size all eigenpairs are computed densely
  double tolerance = 1e-13;  ///< asked of ARPACK, relative to the eigenvalue
  int restarts = 300;        ///< before giving up
  bool copies = true;        ///< whether missed copies of multiple eigenvalues are sought
};

/// Sorted by descending magnitude. For a real operator a conjugate pair is complete or absent.
struct OperatorEigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;   ///< columns of length one
  Eigen::VectorXd residuals;  ///< |T x - mu x| / |mu|, by a new application of T
  bool all = false;           ///< whether these are all eigenpairs of the operator
};

/// Finds at least the `count` eigenpairs of largest magnitude, or all if there are fewer.
/// @throws ComputationError when ARPACK does not converge
OperatorEigenpairs largest_eigenpairs(const LinearOperator<double>& T, Eigen::Index count,
                                      const OperatorEigenOptions& options = {});
OperatorEigenpairs largest_eigenpairs(const LinearOperator<std::complex<double>>& T, Eigen::Index count,
                                      const OperatorEigenOptions& options = {});

}  // namespace bielle
