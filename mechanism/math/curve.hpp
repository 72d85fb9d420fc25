// A smooth curve through points.
//
// Each coordinate is a cubic spline of one parameter u, which grows by the distance of the points (chord length) and is
// therefore close to the arc length. Closed curves are periodic: u may run round any number of times. Open curves
// continue straight beyond their ends.
#pragma once

#include <array>
#include <vector>

#include "mechanism/math/types.hpp"
#include "reduce/common/formula/interpolation.hpp"

namespace bielle::mechanism {

class Curve {
 public:
  /// @param points  points (n, 3) with n >= 2; n >= 3 for a closed curve, whose first point is not repeated
  /// @param name    name of the points in messages
  /// @throws InputError if neighbouring points coincide or points are too few
  Curve(const Eigen::Ref<const MatrixX>& points, bool closed, const std::string& name);

  struct Place {
    Vector3 point, first, second;  ///< c, dc/du, d2c/du2
  };
  Place operator()(double u) const;
  bool closed() const { return closed_; }
  double end() const { return knots_.back(); }  ///< largest u, which begins with 0; the period of a closed curve
  /// Returns the arc length from u = 0, which is negative for u < 0, by Gauss quadrature on sixteen parts of each
  /// piece.
  double arc_length(double u) const;
  /// Returns the parameter of the point of the curve that is closest to a given point.
  double nearest(const Vector3& point) const;

 private:
  double length_within(double from, double to) const;
  bool closed_;
  std::vector<double> knots_;
  std::vector<double> lengths_;  ///< arc length at the knots
  std::vector<Interpolation> coordinates_;
};

}  // namespace bielle::mechanism
