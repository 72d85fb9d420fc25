// A road whose height varies along its length: z = f(x) in the axes of the road, the same for all y.
//
// f is a cubic spline of a table; beyond its ends the road continues straight. A tyre touches the profile at the point
// that is nearest to the middle of the wheel, in the plane of x and z. The point is unique if the valleys of the road
// are wider than the tyre, which the reader checks.
#pragma once

#include <string>
#include <vector>

#include "mechanism/measures/pair_measure.hpp"
#include "reduce/common/formula/interpolation.hpp"

namespace bielle::mechanism {

class RoadProfile {
 public:
  /// @param table  distances and heights [m], two columns, distances ascend @param name  of the table in messages
  /// @throws InputError
  RoadProfile(const Eigen::Ref<const MatrixX>& table, const std::string& name);

  /// Height f [m] with its derivatives by x.
  struct Values {
    double height, slope, curvature, third;
  };
  Values operator()(double x) const;

  /// Returns x of the point nearest to a place, among those that are not farther along x than `reach` [m].
  double nearest(double x, double z, double reach) const;

  /// The point of the road nearest to a place: distance d, negative below the road, and the unit normal there,
  /// (normal_x, 0, normal_z).
  template <int order>
  struct Foot {
    PairMeasureOf<order> distance, normal_x, normal_z;
  };
  /// Computes the nearest point, for orders 1 and 2. @param x,z  the place as measures [m] @param reach  as `nearest`
  template <int order>
  Foot<order> foot(const PairMeasureOf<order>& x, const PairMeasureOf<order>& z, double reach) const;

  /// A valley: its place and radius of curvature [m].
  struct Valley {
    double x, radius;
  };
  /// Returns the tightest valley; its radius is infinite if there is none.
  Valley tightest_valley() const;
  /// Returns points (x, 0, z) of the table and between them, for drawings of the road.
  std::vector<std::vector<double>> line() const;

 private:
  Interpolation heights_;
  std::vector<double> curvatures_;  ///< at the points of the table
};

}  // namespace bielle::mechanism
