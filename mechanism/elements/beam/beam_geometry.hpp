// Reference line of a beam: straight, or an arc of a circle, with section axes that may twist.
//
// Section frame at s in [0, 1]: x along the line, y and z normal to it. From the start the axes follow the line
// (rotated with the arc's plane curvature, without torsion) and are rotated about x by s times the twist.
#pragma once

#include "mechanism/math/se3.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A straight line or circular arc from one point to another.
class BeamLine {
 public:
  static BeamLine straight(const Vector3& start, const Vector3& end);
  /// Constructs the arc from `start` to `end` about `axis` (unit vector, through `centre`) over `angle` [rad] > 0.
  static BeamLine arc(const Vector3& start, const Vector3& centre, const Vector3& axis, double angle);

  Vector3 point(double s) const;
  Vector3 start_tangent() const;           ///< unit vector
  double length() const;                   ///< [m]
  double angle() const { return angle_; }  ///< [rad]; zero for a straight line

  /// Section frame at s. @param R_start  section axes at the start (x = start_tangent) @param twist [rad] from start to
  /// end
  Frame frame(double s, const Matrix3& R_start, double twist) const;
  /// Derivative of the section frame by s, in its own axes: [length along x; rotation].
  Vector6 rate(double s, const Matrix3& R_start, double twist) const;

 private:
  Vector3 start_ = Vector3::Zero(), along_ = Vector3::Zero();   // for a straight line: end - start
  Vector3 centre_ = Vector3::Zero(), axis_ = Vector3::UnitZ();  // for an arc
  double angle_ = 0;
};

/// Reads the line that an entry's `arc_centre` or `arc_through` describes between two points; it is straight without
/// them.
BeamLine read_beam_line(const YamlValue& entry, const Vector3& start, const Vector3& end);

/// Reads the section axes at the start: y is the part of `orientation` normal to the tangent; by default `orientation`
/// is the inertial axis most normal to the tangent (x before y before z if several are equally normal).
Matrix3 read_start_axes(const YamlValue& entry, const Vector3& tangent);

}  // namespace bielle::mechanism
