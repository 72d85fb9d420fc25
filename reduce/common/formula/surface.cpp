#include "reduce/common/formula/surface.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle {
namespace {

void check_ascends(const Eigen::VectorXd& points, const std::string& direction, const std::string& name) {
  if (points.size() < 2) throw InputError(fmt::format("{}: a grid needs at least two values of {}", name, direction));
  for (Eigen::Index i = 1; i < points.size(); ++i)
    if (!(points(i) > points(i - 1)))
      throw InputError(fmt::format("{}: {} must ascend, but {} follows {}", name, direction, points(i), points(i - 1)));
}

/// Returns the index of the interval that contains v. @throws ComputationError outside the points
Eigen::Index find_interval(const Eigen::VectorXd& points, double v, bool from_right, const std::string& direction,
                           const std::string& name) {
  const double first = points(0), last = points(points.size() - 1), rounding = 1e-9 * (last - first);
  if (!(v >= first - rounding && v <= last + rounding))
    throw ComputationError(
        fmt::format("{} = {} is outside the table '{}', which runs from {} to {}", direction, v, name, first, last));
  const double* begin = points.data();
  const double* end = begin + points.size();
  const double* right = from_right ? std::upper_bound(begin, end, v) : std::lower_bound(begin, end, v);
  return std::clamp<Eigen::Index>(right - begin - 1, 0, points.size() - 2);
}

/// The cubic over an interval as a linear function of the values and second derivatives at its ends, with its first and
/// second derivatives.
struct CubicPiece {
  double h, a, b;  ///< length; distances from the right and the left end, relative to it
  CubicPiece(const Eigen::VectorXd& points, Eigen::Index i, double v)
      : h(points(i + 1) - points(i)), a((points(i + 1) - v) / h), b((v - points(i)) / h) {}
  double value(double f0, double f1, double M0, double M1) const {
    return a * f0 + b * f1 + ((a * a * a - a) * M0 + (b * b * b - b) * M1) * h * h / 6;
  }
  double slope(double f0, double f1, double M0, double M1) const {
    return (f1 - f0) / h + ((1 - 3 * a * a) * M0 + (3 * b * b - 1) * M1) * h / 6;
  }
  double curvature(double M0, double M1) const { return a * M0 + b * M1; }
};

}  // namespace

Surface::Surface(Eigen::VectorXd x, Eigen::VectorXd y, Eigen::MatrixXd z, Interpolation::Kind kind, std::string name)
    : x_(std::move(x)), y_(std::move(y)), z_(std::move(z)), kind_(kind), name_(std::move(name)) {
  check_ascends(x_, "x", name_);
  check_ascends(y_, "y", name_);
  zxx_ = zyy_ = zxxyy_ = Eigen::MatrixXd::Zero(x_.size(), y_.size());
  if (kind_ == Interpolation::Kind::linear) return;
  const auto curvature = [&](const Eigen::VectorXd& points, const Eigen::VectorXd& values) {
    const Interpolation spline(points, values, Interpolation::Kind::cubic, name_);
    return Eigen::VectorXd(points.unaryExpr([&](double v) { return spline(v).curvature; }));
  };
  for (Eigen::Index j = 0; j < y_.size(); ++j) zxx_.col(j) = curvature(x_, z_.col(j));
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    zyy_.row(i) = curvature(y_, z_.row(i).transpose()).transpose();
    zxxyy_.row(i) = curvature(y_, zxx_.row(i).transpose()).transpose();
  }
}

Surface Surface::from_file(const std::string& path, Interpolation::Kind kind) {
  const Eigen::MatrixXd table = read_table(path, 3);
  const Eigen::Index rows = table.rows();
  Eigen::Index columns = 1;
  while (columns < rows && table(columns, 0) == table(0, 0)) ++columns;
  if (rows % columns != 0)
    throw InputError(fmt::format("{}: expected for each x the {} values of y of the first one, x = {}; found {} rows",
                                 path, columns, table(0, 0), rows));
  const Eigen::Index lines = rows / columns;
  Eigen::VectorXd x(lines), y = table.col(1).head(columns);
  Eigen::MatrixXd z(lines, columns);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Eigen::Index i = r / columns, j = r % columns;
    if (j == 0) x(i) = table(r, 0);
    if (table(r, 0) != x(i) || table(r, 1) != y(j))
      throw InputError(
          fmt::format("{}: expected the point x = {}, y = {} in row {}, found x = {}, y = {}: for each x "
                      "all y of the first one",
                      path, x(i), y(j), r + 1, table(r, 0), table(r, 1)));
    z(i, j) = table(r, 2);
  }
  return {std::move(x), std::move(y), std::move(z), kind, path};
}

Surface::Values Surface::operator()(double x, double y, bool x_from_right, bool y_from_right) const {
  const Eigen::Index i = find_interval(x_, x, x_from_right, "x", name_),
                     j = find_interval(y_, y, y_from_right, "y", name_);
  const CubicPiece px(x_, i, x), py(y_, j, y);
  // The row splines in y at both ends of the interval of x, and those of the second derivatives by x.
  struct {
    double value, slope, curvature;
  } f[2], M[2];
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Eigen::Index r = i + k;
    f[k] = {py.value(z_(r, j), z_(r, j + 1), zyy_(r, j), zyy_(r, j + 1)),
            py.slope(z_(r, j), z_(r, j + 1), zyy_(r, j), zyy_(r, j + 1)), py.curvature(zyy_(r, j), zyy_(r, j + 1))};
    M[k] = {py.value(zxx_(r, j), zxx_(r, j + 1), zxxyy_(r, j), zxxyy_(r, j + 1)),
            py.slope(zxx_(r, j), zxx_(r, j + 1), zxxyy_(r, j), zxxyy_(r, j + 1)),
            py.curvature(zxxyy_(r, j), zxxyy_(r, j + 1))};
  }
  return {px.value(f[0].value, f[1].value, M[0].value, M[1].value),
          px.slope(f[0].value, f[1].value, M[0].value, M[1].value),
          px.value(f[0].slope, f[1].slope, M[0].slope, M[1].slope),
          px.curvature(M[0].value, M[1].value),
          px.slope(f[0].slope, f[1].slope, M[0].slope, M[1].slope),
          px.value(f[0].curvature, f[1].curvature, M[0].curvature, M[1].curvature)};
}

}  // namespace bielle
