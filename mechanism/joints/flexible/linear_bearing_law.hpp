// Linear force of a bearing, N = K e + D v in the first five measures, with radial coefficients that may depend on the
// speed of the shaft.
#pragma once

#include <array>
#include <optional>

#include "mechanism/joints/flexible/bearing_law.hpp"
#include "reduce/common/formula/interpolation.hpp"

namespace bielle::mechanism {

/// Radial coefficients over the speed of the shaft: straight lines between its points, constant beyond them.
class FilmCoefficients {
 public:
  /// @param table  rows [speed [rad/s], kxx, kxy, kyx, kyy [N/m], cxx, cxy, cyx, cyy [N s/m]], speeds ascending
  explicit FilmCoefficients(const Eigen::MatrixXd& table, const std::string& name);
  struct At {
    Eigen::Matrix2d K, D, K_slope, D_slope;
  };
  At operator()(double speed) const;
  double first() const { return first_; }
  double last() const { return last_; }

 private:
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
