#include "reduce/superelement/inertia_tensor.hpp"

#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle {

namespace {

Eigen::Matrix3d symmetric_tensor(double xx, double yy, double zz, double xy, double xz, double yz) {
  Eigen::Matrix3d J;
  J << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return J;
}

}  // namespace

KeyForms inertia_tensor_forms() {
  using namespace keys;
  const char* unit = "kg m^2";
  return {list_of(3, number(unit)), list_of(6, number(unit)), matrix(3, 3, unit)};
}

Eigen::Matrix3d read_inertia_tensor(const YamlValue& value) {
  const std::string expected =
      "expected the inertia tensor as [xx, yy, zz], [xx, yy, zz, xy, xz, yz] or three rows of "
      "three";
  if (!value.is_sequence()) value.fail(expected);
  if (value.size() == 6) {
    const Eigen::VectorXd e = value.vector();
    return symmetric_tensor(e[0], e[1], e[2], e[3], e[4], e[5]);
  }
  if (value.size() != 3) value.fail(expected);
  if (!value.at(std::size_t{0}).is_sequence()) {
    const Eigen::Vector3d e = value.vector3();
    return symmetric_tensor(e[0], e[1], e[2], 0, 0, 0);
  }
  const Eigen::Matrix3d J = value.matrix(3, 3);
  if (!(J - J.transpose()).isZero(1e-9 * J.cwiseAbs().maxCoeff())) value.fail("an inertia tensor is symmetric");
  return 0.5 * (J + J.transpose());
}

std::string inertia_fault(const Eigen::Matrix3d& inertia) {
  if (!inertia.allFinite()) return "the inertia tensor about the centre of mass is too large for a number";
  const Eigen::Vector3d p = symmetric_eigenpairs(inertia).values;
  const std::string found = fmt::format("its principal moments are {:.6g}, {:.6g} and {:.6g} kg m^2", p[0], p[1], p[2]);
  // The limit includes the rounding of a tensor in axes that are not principal axes.
  if (!(p[0] >= -1e-9 * p[2] && p[2] > 0))
    return "the inertia tensor about the centre of mass must be positive definite (one principal moment may be zero: a "
           "line of mass); " +
           found;
  if (p[2] > (p[0] + p[1]) * (1 + 1e-3))
    return "no body has this inertia about its centre of mass: the largest principal moment exceeds the sum of the two "
           "others; " +
           found;
  return "";
}

}  // namespace bielle
