// A function given by points: straight lines or a cubic spline between them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

/// y(x) through points with ascending x; defined between the first and the last point only.
///
/// `linear` has kinks at the points. `cubic` is the spline with continuous second derivative and the not-a-knot
/// condition at both ends (it reproduces a cubic exactly; three points give a parabola, two a straight line).
/// `periodic` is the cubic spline that repeats itself: the last point has the first value, and x may be any number.
/// Reference: C. de Boor, A Practical Guide to Splines, chapter IV.
class Interpolation {
 public:
  enum class Kind { linear, cubic, periodic };
  struct Values {
    double value, slope, curvature;
  };

  /// @param name  stands for the table in messages
  /// @throws InputError when there are fewer than two points or x does not ascend strictly
  Interpolation(Eigen::VectorXd x, Eigen::VectorXd y, Kind kind, std::string name);
  /// Reads the two columns of a text file (see read_table).
  static Interpolation from_file(const std::string& path, Kind kind);

  /// @param from_right  selects the derivatives on the right at a point of the table; otherwise those on the left
  /// @throws ComputationError outside the range of the points (rounding of 1e-9 of the range is tolerated)
  Values operator()(double x, bool from_right = true) const;
  /// Integral of y from the first point to x; exact, over any number of periods. @throws as operator()
  double integral(double x) const;
  std::span<const double> points() const { return {x_.data(), static_cast<std::size_t>(x_.size())}; }
  Kind kind() const { return kind_; }

 private:
  /// Returns the index of the piece that contains x, and moves x of a periodic spline into its first period.
  /// @throws ComputationError outside the range
  Eigen::Index find_piece(double& x, bool from_right) const;
  Eigen::VectorXd x_, y_;
  Eigen::VectorXd curvature_;  ///< y'' at the points; zero when linear
  Eigen::VectorXd area_;       ///< integral up to the points
  Kind kind_;
  std::string name_;
};

}  // namespace bielle
