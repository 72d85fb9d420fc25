// Linear force of a bearing, N = K e + D v in the first five measures, with coefficients that may depend on the speed
// of the shaft: radial ones or all.
#pragma once

#include <array>
#include <optional>

#include "mechanism/joints/flexible/bearing_law.hpp"
#include "reduce/common/formula/interpolation.hpp"

namespace bielle::mechanism {

/// Coefficients of the first n measures over the speed of the shaft: straight lines between its points, constant beyond
/// them.
class FilmCoefficients {
 public:
  /// Columns of a table of n measures.
  static constexpr Eigen::Index columns(Eigen::Index measures) { return 1 + 2 * measures * measures; }
  /// @param measures  2 (radial) or 5   @param table  rows [speed [rad/s], stiffness by rows (n^2), damping (n^2)],
  /// SI units, speeds ascending
  FilmCoefficients(Eigen::Index measures, const Eigen::MatrixXd& table, const std::string& name);
  struct At {
    Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero(), K_slope = Matrix6::Zero(), D_slope = Matrix6::Zero();
  };
  At operator()(double speed) const;
  double first() const { return first_; }
  double last() const { return last_; }

 private:
  Eigen::Index measures_;
  double first_, last_;
  std::vector<Interpolation> coefficients_;
};

class LinearBearingLaw final : public BearingLaw {
 public:
  Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero();  ///< last row and column are zero
  std::optional<FilmCoefficients> film;

  Force calc(const Vector6& e, const Vector6& v) const override;
  Potential potential(const Vector6& e) const override;
  bool has_rates() const override { return film || !D.isZero(0); }
  bool has_kinks() const override { return film.has_value(); }
  std::vector<std::string> describe() const override;
};

}  // namespace bielle::mechanism
