// Linear force of a bearing, N = K e + D v in the first five measures, with coefficients that may depend on the speed
// of the shaft: radial ones or all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/joints/flexible/bearing_law.hpp"
#include "mechanism/laws/film_coefficients.hpp"

namespace bielle::mechanism {

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
