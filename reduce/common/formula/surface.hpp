// A function of two variables given by values on a grid: bilinear or bicubic between them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/formula/interpolation.hpp"

namespace bielle {

/// z(x, y) through the points of a rectangular grid with ascending x and y; defined within the grid only.
///
/// `linear` is bilinear, with kinks along the lines of the grid. `cubic` is the tensor product of cubic splines with
/// continuous second derivatives and the not-a-knot condition at the borders: it reproduces a bicubic polynomial
/// exactly. Reference: C. de Boor, A Practical Guide to Splines, chapter XVII.
class Surface {
 public:
  /// Value, first and second derivatives.
  struct Values {
    double value, x, y, xx, xy, yy;
  };

  /// @param z     values, a row for each x and a column for each y
  /// @param name  stands for the table in messages
  /// @throws InputError when there are fewer than two points in a direction or they do not ascend strictly
  Surface(Eigen::VectorXd x, Eigen::VectorXd y, Eigen::MatrixXd z, Interpolation::Kind kind, std::string name);
  /// Reads the three columns x, y, z of a text file (see read_table), a row for each point of the grid: for the first x
  /// all y, then for the next x the same y.
  static Surface from_file(const std::string& path, Interpolation::Kind kind);

  /// @param x_from_right,y_from_right  select the derivatives on the right on a line of the grid; otherwise those on
  ///         the left
  /// @throws ComputationError outside the grid (rounding of 1e-9 of the range is tolerated)
  Values operator()(double x, double y, bool x_from_right = true, bool y_from_right = true) const;
  Interpolation::Kind kind() const { return kind_; }
  const Eigen::VectorXd& x_points() const { return x_; }
  const Eigen::VectorXd& y_points() const { return y_; }

 private:
  Eigen::VectorXd x_, y_;
  Eigen::MatrixXd z_, zxx_, zyy_, zxxyy_;  ///< values and even derivatives at the points; zero when linear
  Interpolation::Kind kind_;
  std::string name_;
};

}  // namespace bielle
