// The contour of a disk cam, and the curves for its followers.
//
// It is given in polar coordinates about the camshaft, anticlockwise, and interpolated by a periodic spline. A roller
// of radius r whose centre moves on the pitch curve c + r n (with the outward normal n) touches the contour. A flat
// face with the normal m(psi) towards the cam touches it at the point farthest along m: at the distance of the support
// function
//     H(psi) = max over u of m . c(u),   m = (cos(psi), sin(psi)).
// H'' + H is the radius of curvature at the contact of the face: the contour must be convex, so that a face can touch
// all of it. References: F. Reuleaux; R. L. Norton, Cam Design and Manufacturing Handbook (2002), chapter 7.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/curve.hpp"

namespace bielle::mechanism {

class CamContour {
 public:
  /// @param polar  (n, 2): angle [rad], ascending over less than a turn, and radius [m], positive
  /// @throws InputError naming the file
  CamContour(const Eigen::Ref<const MatrixX>& polar, std::string name);
  std::vector<Vector3> points() const;  ///< points of the contour, anticlockwise [m]
  /// @throws InputError if the roller is too large for a concave part of the contour
  Curve pitch_curve(double radius) const;
  /// Returns the periodic function H(psi). @throws InputError  if the contour is concave
  Interpolation support() const;

 private:
  struct Sample {
    Vector3 point, normal;
    double curvature;  ///< positive: convex
  };
  std::vector<Sample> sample(int per_piece) const;
  std::string name_;
  Eigen::Index points_;
  Curve contour_;
};

}  // namespace bielle::mechanism
