#include "reduce/matrices/set_mass.hpp"

#include <cmath>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

Eigen::Vector3d SetMass::principal() const { return symmetric_eigenpairs(inertia).values; }

Eigen::Vector3d SetMass::box() const {
  const Eigen::Vector3d moments = principal();
  // A box a, b, c has I_a = m (b^2 + c^2) / 12.
  return ((moments.sum() / 2 - moments.array()).max(0) * 12 / mass()).sqrt();
}

SetMass mass_of(const MatrixStudy& study) {
  const Eigen::MatrixXd momenta = study.mass * *study.geometric;
  const Eigen::Matrix<double, 6, 6> m = transposed_product(*study.geometric, momenta);
  SetMass result;
  result.along = m.diagonal().head<3>();
  // The coupling block is -m d~, with d from the middle to the centre.
  const Eigen::Matrix3d coupling = m.topRightCorner<3, 3>();
  const Eigen::Vector3d offset = Eigen::Vector3d(coupling(1, 2) - coupling(2, 1), coupling(2, 0) - coupling(0, 2),
                                                 coupling(0, 1) - coupling(1, 0)) /
                                 (2 * result.mass());
  result.centre = study.middle + offset;
  result.inertia = m.bottomRightCorner<3, 3>() + result.mass() * skew(offset) * skew(offset);
  result.at_origin = result.inertia - result.mass() * skew(result.centre) * skew(result.centre);
  Eigen::Matrix3d between = m.topLeftCorner<3, 3>();
  between.diagonal().setZero();
  result.odd = std::max(between.cwiseAbs().maxCoeff(),
                        (coupling + coupling.transpose()).cwiseAbs().maxCoeff() / 2 / study.length) /
               std::abs(result.mass());
  return result;
}

}  // namespace bielle::reduce
