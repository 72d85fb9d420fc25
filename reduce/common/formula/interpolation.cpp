#include "reduce/common/formula/interpolation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle {

namespace {

/// Solves a tridiagonal system with a dominant diagonal; the right-hand sides are the columns of `right`, which become
/// the solutions.
void solve_tridiagonal(const Eigen::VectorXd& lower, Eigen::VectorXd diagonal, const Eigen::VectorXd& upper,
                       Eigen::Ref<Eigen::MatrixXd> right) {
  const Eigen::Index m = diagonal.size();
  for (Eigen::Index i = 1; i < m; ++i) {
    const double factor = lower(i) / diagonal(i - 1);
    diagonal(i) -= factor * upper(i - 1);
    right.row(i) -= factor * right.row(i - 1);
  }
  right.row(m - 1) /= diagonal(m - 1);
  for (Eigen::Index i = m - 2; i >= 0; --i) right.row(i) = (right.row(i) - upper(i) * right.row(i + 1)) / diagonal(i);
}

/// Returns the second derivatives of the periodic cubic spline: the equations below hold at all points, and the first
/// and last points coincide. The corners of the matrix are removed by an update of rank one (Sherman-Morrison).
Eigen::VectorXd periodic_curvature(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::Index n = x.size(), m = n - 1;  // unknowns M_0 .. M_{n-2}
  Eigen::VectorXd h(m), s(m), lower(m), diagonal(m), upper(m);
  Eigen::MatrixXd right(m, 2);
  for (Eigen::Index i = 0; i < m; ++i) {
    h(i) = x(i + 1) - x(i);
    s(i) = (y(i + 1) - y(i)) / h(i);
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index before = i == 0 ? m - 1 : i - 1;
    lower(i) = h(before);
    upper(i) = h(i);
    diagonal(i) = 2 * (h(before) + h(i));
    right(i, 0) = 6 * (s(i) - s(before));
    right(i, 1) = 0;
  }
  const double corner = h(m - 1), gamma = -diagonal(0);
  right(0, 1) = gamma;
  right(m - 1, 1) = corner;
  diagonal(0) -= gamma;
  diagonal(m - 1) -= corner * corner / gamma;
  solve_tridiagonal(lower, diagonal, upper, right);
  const double along = corner / gamma;
  const double part = (right(0, 0) + along * right(m - 1, 0)) / (1 + right(0, 1) + along * right(m - 1, 1));
  Eigen::VectorXd M(n);
  M.head(m) = right.col(0) - part * right.col(1);
  M(m) = M(0);
  return M;
}

/// Returns the second derivatives M of the not-a-knot cubic spline at its points:
///   h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (s_i - s_{i-1}),  i = 1 .. n-2,  s_i = (y_{i+1} - y_i) /
///   h_i
/// The condition of a continuous third derivative at points 1 and n-2 eliminates M_0 and M_{n-1}.
Eigen::VectorXd spline_curvature(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::Index n = x.size();
  if (n == 2) return Eigen::VectorXd::Zero(2);
  const Eigen::VectorXd h = x.tail(n - 1) - x.head(n - 1);
  const Eigen::VectorXd s = (y.tail(n - 1) - y.head(n - 1)).cwiseQuotient(h);
  if (n == 3) return Eigen::VectorXd::Constant(3, 2 * (s(1) - s(0)) / (h(0) + h(1)));

  const Eigen::Index m = n - 2;  // unknowns M_1 .. M_{n-2}
  Eigen::VectorXd lower(m), diagonal(m), upper(m), right(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    lower(i) = h(i);
    diagonal(i) = 2 * (h(i) + h(i + 1));
    upper(i) = h(i + 1);
    right(i) = 6 * (s(i + 1) - s(i));
  }
  const double first = h(0) / h(1), last = h(n - 2) / h(n - 3);
  diagonal(0) += h(0) * (1 + first);
  upper(0) -= h(0) * first;
  diagonal(m - 1) += h(n - 2) * (1 + last);
  lower(m - 1) -= h(n - 2) * last;
  solve_tridiagonal(lower, diagonal, upper, right);
  Eigen::VectorXd M(n);
  M.segment(1, m) = right;
  M(0) = M(1) * (1 + first) - M(2) * first;
  M(n - 1) = M(n - 2) * (1 + last) - M(n - 3) * last;
  return M;
}

/// Returns the integral of a cubic over a length h, from its values and second derivatives at both ends: the
/// trapezoidal rule and its first correction.
double area_of_cubic(double h, double y_0, double y_1, double M_0, double M_1) {
  return h / 2 * (y_0 + y_1) - h * h * h / 24 * (M_0 + M_1);
}

}  // namespace

Interpolation::Interpolation(Eigen::VectorXd x, Eigen::VectorXd y, Kind kind, std::string name)
    : x_(std::move(x)), y_(std::move(y)), kind_(kind), name_(std::move(name)) {
  if (x_.size() < 2) throw InputError(fmt::format("{}: an interpolation needs at least two points", name_));
  for (Eigen::Index i = 1; i < x_.size(); ++i)
    if (x_(i) <= x_(i - 1))
      throw InputError(fmt::format("{}: the first column must ascend, but {} follows {}", name_, x_(i), x_(i - 1)));
  if (kind_ == Kind::periodic) {
    if (x_.size() < 4)
      throw InputError(fmt::format("{}: a periodic spline needs three points and the first again", name_));
    if (y_(0) != y_(y_.size() - 1)) throw InputError(fmt::format("{}: the last value must repeat the first", name_));
    curvature_ = periodic_curvature(x_, y_);
  } else {
    curvature_ = kind_ == Kind::cubic ? spline_curvature(x_, y_) : Eigen::VectorXd(Eigen::VectorXd::Zero(x_.size()));
  }
  area_ = Eigen::VectorXd::Zero(x_.size());
  for (Eigen::Index i = 1; i < x_.size(); ++i)
    area_(i) = area_(i - 1) + area_of_cubic(x_(i) - x_(i - 1), y_(i - 1), y_(i), curvature_(i - 1), curvature_(i));
}

Interpolation Interpolation::from_file(const std::string& path, Kind kind) {
  const Eigen::MatrixXd table = read_table(path, 2);
  return {table.col(0), table.col(1), kind, path};
}

Eigen::Index Interpolation::find_piece(double& x, bool from_right) const {
  const double first = x_(0), last = x_(x_.size() - 1), rounding = 1e-9 * (last - first);
  if (kind_ == Kind::periodic) x -= (last - first) * std::floor((x - first) / (last - first));
  if (!(x >= first - rounding && x <= last + rounding))
    throw ComputationError(
        fmt::format("{} is outside the table '{}', which runs from {} to {}", x, name_, first, last));
  const double* begin = x_.data();
  const double* end = begin + x_.size();
  const double* right = from_right ? std::upper_bound(begin, end, x) : std::lower_bound(begin, end, x);
  return std::clamp<Eigen::Index>(right - begin - 1, 0, x_.size() - 2);
}

double Interpolation::integral(double x) const {
  double periods = 0;
  if (kind_ == Kind::periodic) periods = std::floor((x - x_(0)) / (x_(x_.size() - 1) - x_(0)));
  const Eigen::Index i = find_piece(x, true);
  const Values at = (*this)(x);
  return periods * area_(area_.size() - 1) + area_(i) +
         area_of_cubic(x - x_(i), y_(i), at.value, curvature_(i), at.curvature);
}

Interpolation::Values Interpolation::operator()(double x, bool from_right) const {
  const Eigen::Index i = find_piece(x, from_right);
  const double h = x_(i + 1) - x_(i), a = (x_(i + 1) - x) / h, b = (x - x_(i)) / h;
  const double M0 = curvature_(i), M1 = curvature_(i + 1);
  return {a * y_(i) + b * y_(i + 1) + ((a * a * a - a) * M0 + (b * b * b - b) * M1) * h * h / 6,
          (y_(i + 1) - y_(i)) / h + ((1 - 3 * a * a) * M0 + (3 * b * b - 1) * M1) * h / 6, a * M0 + b * M1};
}

}  // namespace bielle
