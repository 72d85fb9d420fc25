// Coefficients of lift, drag and moment of an airfoil by the angle of attack, which vary along the beam.
//
// They are formulas of alpha and s, or the polars of several stations: between two stations the coefficients at the
// same alpha are interpolated linearly in s, before the first and after the last one they are constant. A station has
// formulas of alpha, or a table of alpha, lift, drag and moment, which straight lines join.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reduce/common/formula/expression.hpp"
#include "reduce/common/formula/interpolation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A coefficient with its derivative by the angle of attack [1/rad].
struct PolarValue {
  double value = 0, slope = 0;
};

class AirfoilPolars {
 public:
  /// Lift, drag, moment.
  using Values = std::array<PolarValue, 3>;
  struct Station {
    double at;          ///< s
    std::string place;  ///< place in the file: "blade.yaml:6: elements.blade.airfoil.polars[1].table"
    std::array<std::variant<Expression, Interpolation>, 3> coefficients;  ///< functions of alpha
    /// @param s  place along the beam, for messages
    Values operator()(double s, double alpha) const;
  };
  AirfoilPolars() = default;  ///< without forces
  /// @param formulas  coefficients by alpha and s
  explicit AirfoilPolars(std::array<Expression, 3> formulas) : formulas_(std::move(formulas)) {}
  /// @param stations  with ascending `at`
  explicit AirfoilPolars(std::vector<Station> stations) : stations_(std::move(stations)) {}

  /// @param s  0 .. 1 along the beam @param alpha  angle of attack [rad]
  /// @throws ComputationError outside a table
  Values operator()(double s, double alpha) const;
  /// Values of s at which a coefficient may have a kink.
  std::vector<double> break_points() const;

 private:
  std::array<Expression, 3> formulas_;  ///< without stations
  std::vector<Station> stations_;
};

/// Keys of `airfoil` that define coefficients: `lift`, `drag`, `moment`, `polars`.
std::vector<Key> airfoil_polar_keys();
/// Reads the coefficients from the map of an airfoil. @throws InputError
AirfoilPolars read_airfoil_polars(const YamlValue& airfoil);

}  // namespace bielle::mechanism
