// Place of a part in the mechanism: it maps vectors of the part's file to inertial axes.
#pragma once

#include "mechanism/math/se3.hpp"
#include "reduce/common/input/key_form.hpp"

namespace bielle::mechanism {

/// A rigid motion after a reflection, from the axes in which a part is written to the inertial ones.
///
/// A mirrored node has the axes M R M (M = the reflection), which are right-handed again: components along its own axes
/// are reflected like those of the part. Vectors of a translation (`polar`) are reflected; vectors of a rotation
/// (`axial`) are reflected and reversed, so that angles, angular velocities and moments about them keep their signs.
struct Placement {
  Frame frame;        ///< frame of the part's axes, in inertial ones
  int mirrored = -1;  ///< axis that is normal to the plane of the reflection; -1: none

  bool is_identity() const;
  bool moves() const;  ///< whether the frame is another one
  /// Returns the reflection, or the identity.
  Matrix3 reflection() const;
  /// Returns the matrix that multiplies three components. @param inertial  components along the part's axes, otherwise
  /// along those of a node
  Matrix3 matrix(KeyForm::Geometry geometry, bool inertial) const;
  /// Returns the orientation of a node, or of something whose orientation is relative to a node.
  Matrix3 orientation(const Matrix3& R, bool inertial) const;
  /// Returns the placement of a part within this one.
  Placement inner(const Placement& part) const;
};

}  // namespace bielle::mechanism
