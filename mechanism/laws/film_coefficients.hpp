// Stiffness and damping over a speed, with all couplings: oil films, seals and magnetic bearings, linearised about
// states of steady rotation. Straight lines lead from one speed of the table to the next, and coefficients are constant
// beyond its ends.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/types.hpp"
#include "reduce/common/formula/interpolation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Coefficients of the first n of six measures.
class FilmCoefficients {
 public:
  /// Returns the number of columns of a table of n measures.
  static constexpr Eigen::Index columns(Eigen::Index measures) { return 1 + 2 * measures * measures; }
  /// @param measures  2 (radial), 5 (a bearing) or 6 (a bushing)   @param table  rows [speed [rad/s], stiffness by rows
  /// (n^2), damping (n^2)], SI units, at least two, speeds ascending @param name  stands for the table in messages
  /// @throws InputError if the speeds do not ascend
  FilmCoefficients(Eigen::Index measures, const Eigen::MatrixXd& table, const std::string& name);
  /// K and D, and their derivatives by the speed; rows and columns of other measures are zero.
  struct At {
    Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero(), K_slope = Matrix6::Zero(), D_slope = Matrix6::Zero();
  };
  At operator()(double speed) const;
  /// Describes the table in words.
  std::string describe() const;

 private:
  Eigen::Index measures_;
  double first_, last_;
  std::vector<Interpolation> coefficients_;
};

/// Reads the file under `table` (radial coefficients) or under `matrices` (all measures).
/// @param given  map with one of the two keys @param all  number of all measures
/// @throws InputError
FilmCoefficients read_film_coefficients(const YamlValue& given, Eigen::Index all);

}  // namespace bielle::mechanism
