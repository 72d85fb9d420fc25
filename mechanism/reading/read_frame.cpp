#include "mechanism/reading/read_frame.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/math/nearest_rotation.hpp"
#include "mechanism/math/rotation_parameters.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& axes_keys() {
  using namespace keys;
  static const KeyTable table{"`axes`",
                              "Two of the axes, in inertial components.",
                              {{"x", direction(), optional, "Direction of the own x axis."},
                               {"y", direction(), optional, "Direction of the own y axis."},
                               {"z", direction(), optional, "Direction of the own z axis."}}};
  return table;
}

Matrix3 read_quaternion(const YamlValue& value) {
  const VectorX q = value.vector();
  if (q.size() != 4) value.fail(fmt::format("expected the four numbers w x y z of a quaternion, found {}", q.size()));
  const double largest = q.cwiseAbs().maxCoeff();
  if (largest == 0) value.fail("a quaternion of length zero is no rotation");
  return rotation_of_quaternion(q / largest);
}

/// Reads two of the axes: the first as given, the second made orthogonal to it.
Matrix3 read_axes(const YamlValue& value) {
  const std::vector<std::pair<std::string, YamlValue>> entries = value.entries();
  if (entries.size() != 2)
    value.fail("expected two of the axes x, y, z: the first as given, the second made orthogonal to it");
  Matrix3 R = Matrix3::Zero();
  const auto index = [](const std::string& name) { return name[0] - 'x'; };
  const int first = index(entries[0].first), second = index(entries[1].first), third = 3 - first - second;
  R.col(first) = entries[0].second.direction();
  Vector3 other = entries[1].second.direction();
  other -= R.col(first) * R.col(first).dot(other);
  if (other.norm() < 1e-9)
    value.fail(fmt::format("axis {} is parallel to axis {}", entries[1].first, entries[0].first));
  R.col(second) = other.normalized();
  const Vector3 cross = R.col(first).cross(R.col(second));
  R.col(third) = (second - first + 3) % 3 == 1 ? cross : Vector3(-cross);
  return R;
}

/// Reads a rotation matrix. Numbers in files have a few digits, so that the rotation nearest to the matrix is used,
/// unless the difference exceeds rounding.
Matrix3 read_matrix(const YamlValue& value) {
  const Matrix3 given = value.matrix(3, 3);
  if (const auto fault = rotation_fault(given))
    value.fail(
        fmt::format("expected a rotation matrix, whose columns are the node's axes in inertial components: of "
                    "length one, orthogonal and right-handed; {}",
                    *fault));
  return nearest_rotation(given);
}

}  // namespace

const std::vector<Key>& orientation_keys() {
  using namespace keys;
  static const std::vector<Key> all = {
      {"rotation_vector", vector3("rad"), optional, "Orientation: the axis of the rotation times its angle."},
      {"quaternion", list_of(4, number()), optional,
       "Orientation: `[w, x, y, z]`, cos(angle/2) and sin(angle/2) times the axis, of any length but zero."},
      {"bryant", vector3("rad"), optional,
       "Orientation: angles a, b, c about x, the new y and the newest z: R = Rx(a) Ry(b) Rz(c)."},
      {"euler", vector3("rad"), optional,
       "Orientation: angles a, b, c about z, the new x and the newest z: R = Rz(a) Rx(b) Rz(c)."},
      {"axes", nested(axes_keys), optional,
       "Orientation: two of the axes; the first as given, the second made orthogonal to it."},
      {"matrix", matrix(3, 3, ""), optional,
       "Orientation: the rotation matrix R by rows, whose columns are the own axes. Rounding of its entries up to 1e-3 "
       "is corrected."},
      {"rodrigues", vector3(""), optional, "Orientation: tan(angle/2) times the axis."},
      {"conformal", vector3(""), optional, "Orientation: 4 tan(angle/4) times the axis (Wiener-Milenkovic)."}};
  return all;
}

const std::vector<Key>& inertial_orientation_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys = orientation_keys();
    for (Key& key : keys)
      for (KeyForm& form : key.forms) form = form.in_inertial_axes();
    return keys;
  }();
  return all;
}

Matrix3 read_orientation(const YamlValue& entry) {
  std::string given;
  for (const Key& key : orientation_keys()) {
    if (!entry.has(key.name)) continue;
    if (!given.empty()) entry.fail(fmt::format("has two orientations, `{}` and `{}`", given, key.name));
    given = key.name;
  }
  if (given.empty()) return Matrix3::Identity();
  const YamlValue value = entry.at(given);
  if (given == "quaternion") return read_quaternion(value);
  if (given == "axes") return read_axes(value);
  if (given == "matrix") return read_matrix(value);
  const Vector3 p = value.vector3();
  const bool angles = given != "rodrigues" && given != "conformal";
  constexpr double largest = 1e6;  // beyond this, fewer than ten digits of the last turn are left
  if (angles && p.cwiseAbs().maxCoeff() > largest)
    value.fail(fmt::format("angles of more than {:.0e} rad do not tell an orientation any more", largest));
  if (angles && p.cwiseAbs().maxCoeff() > 2 * M_PI)
    value.warn(fmt::format("is {:g} meant? Angles are in radians; 90 degrees are pi/2", p.cwiseAbs().maxCoeff()));
  if (given == "rotation_vector") return RotationVector::rotation(p);
  if (given == "bryant") return BryantAngles::rotation(p);
  if (given == "euler") return EulerAngles::rotation(p);
  if (given == "rodrigues") return RodriguesVector::rotation(p);
  return ConformalVector::rotation(p);
}

std::vector<Key> frame_keys() {
  using namespace keys;
  return joined(
      {{{"position", vector3("m").as_point().in_inertial_axes(), otherwise("[0, 0, 0]"), "Position of the origin."}},
       inertial_orientation_keys()});
}

std::vector<Key> own_frame_keys() {
  using namespace keys;
  return joined(
      {{{"position", vector3("m").as_point(), otherwise("[0, 0, 0]"), "Position of the origin."}}, orientation_keys()});
}

Frame read_frame(const YamlValue& entry) { return {entry.at("position").vector3(), read_orientation(entry)}; }

}  // namespace bielle::mechanism
