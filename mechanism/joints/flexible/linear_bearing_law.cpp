#include "mechanism/joints/flexible/linear_bearing_law.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {

FilmCoefficients::FilmCoefficients(Eigen::Index measures, const Eigen::MatrixXd& table, const std::string& name)
    : measures_(measures), first_(table(0, 0)), last_(table(table.rows() - 1, 0)) {
  for (Eigen::Index k = 1; k < table.cols(); ++k)
    coefficients_.emplace_back(table.col(0), table.col(k), Interpolation::Kind::linear, name);
}

FilmCoefficients::At FilmCoefficients::operator()(double speed) const {
  At at;
  const bool inside = speed > first_ && speed < last_;
  const double held = std::clamp(speed, first_, last_);
  const auto set = [&](std::size_t k, double& value, double& slope) {
    const Interpolation::Values found = coefficients_[k](held);
    value = found.value;
    slope = inside ? found.slope : 0;
  };
  std::size_t k = 0;
  for (Matrix6* const matrix : {&at.K, &at.D}) {
    Matrix6& slopes = matrix == &at.K ? at.K_slope : at.D_slope;
    for (Eigen::Index row = 0; row < measures_; ++row)
      for (Eigen::Index column = 0; column < measures_; ++column) set(k++, (*matrix)(row, column), slopes(row, column));
  }
  return at;
}

BearingLaw::Force LinearBearingLaw::calc(const Vector6& e, const Vector6& v) const {
  Force force{K * e + D * v, K, D};
  if (film) {
    const FilmCoefficients::At at = (*film)(v[5]);
    force.N += at.K * e + at.D * v;
    force.by_e += at.K;
    force.by_v += at.D;
    force.by_v.col(5) += at.K_slope * e + at.D_slope * v;
  }
  return force;
}

BearingLaw::Potential LinearBearingLaw::potential(const Vector6& e) const {
  const Vector6 N = 0.5 * (K + K.transpose()) * e;
  return {0.5 * e.dot(N), N};
}

std::vector<std::string> LinearBearingLaw::describe() const {
  const auto words = [](const Matrix6& A, const char* along, const char* about) {
    const std::string text = fmt::format("[{:.6g}, {:.6g}, {:.6g}] {}, [{:.6g}, {:.6g}] {}", A(0, 0), A(1, 1), A(2, 2),
                                         along, A(3, 3), A(4, 4), about);
    return A.isDiagonal(0) ? text : "a full matrix, diagonal " + text;
  };
  std::vector<std::string> facts;
  if (!K.isZero(0)) facts.push_back("stiffness " + words(K, "N/m", "N m/rad"));
  if (!D.isZero(0)) facts.push_back("damping " + words(D, "N s/m", "N m s/rad"));
  if (film) facts.push_back(fmt::format("film coefficients from {:.6g} to {:.6g} rad/s", film->first(), film->last()));
  return facts;
}

}  // namespace bielle::mechanism
