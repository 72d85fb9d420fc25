#include "reduce/body_file/body_axes.hpp"

#include <Eigen/Geometry>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

const KeyTable& axes_keys() {
  using namespace keys;
  static const KeyTable table{"axes",
                              "Directions of two axes in the body; the third is normal to both.",
                              {{"x", direction(), required, "Direction of the x axis."},
                               {"y", direction(), required, "Direction of the y axis, which is made normal to x."}}};
  return table;
}

Eigen::Matrix3d read_axes(const YamlValue& value) {
  return triad(value.at("x").direction(), value.at("y").direction(), value);
}

Eigen::Matrix3d triad(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const YamlValue& place) {
  const Eigen::Vector3d z = x.cross(y);
  // Below this angle to z, the direction of y is too inaccurate to be used.
  if (z.norm() < 1e-6) place.fail("expected two directions that are not parallel");
  Eigen::Matrix3d axes;
  axes << x, z.normalized().cross(x), z.normalized();
  return axes;
}

Eigen::Matrix3d read_rotation_vector(const YamlValue& value) {
  const Eigen::Vector3d psi = value.vector3();
  if (psi.norm() == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(psi.norm(), psi.normalized()).toRotationMatrix();
}

}  // namespace bielle::reduce
