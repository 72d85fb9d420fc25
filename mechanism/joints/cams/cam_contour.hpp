// The contour of a disk cam, and what a follower sees of it.
//
// Given in polar coordinates about the camshaft, anticlockwise, and joined by a periodic spline. A roller of radius r
// whose centre moves on the pitch curve c + r n (n the outward normal) touches the contour. A flat face with the normal
// m(psi) towards the cam touches it where it is farthest along m: at the distance of the support function
//     H(psi) = max over u of m . c(u),   m = (cos(psi), sin(psi)).
// H'' + H is the radius of curvature where the face touches: that a face reaches all of the contour takes a convex one.
// References: F. Reuleaux; R. L. Norton, Cam Design and Manufacturing Handbook (2002), chapter 7.
#pragma once

#include <string>

#include "mechanism/math/curve.hpp"

namespace bielle::mechanism {

class CamContour {
 public:
  /// @param polar  (n, 2): angle [rad], ascending over less than a turn, and radius [m], positive
  /// @throws InputError  naming the file
  CamContour(const Eigen::Ref<const MatrixX>& polar, std::string name);
  /// @throws InputError  where the roller is too large for a hollow of the contour
  Curve pitch_curve(double radius) const;
  /// H over psi, periodic. @throws InputError  where the contour is hollow
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
