// A force as a function of a displacement, given by the points of a file joined by straight lines, and its exact
// energy.
//
// Beyond its first and last point the curve continues along its first and last line, with the stiffness of that line.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class ForceCurve {
 public:
  /// Reads two columns of a file, with ascending displacements and at least two points.
  /// @throws InputError
  static ForceCurve from_file(const std::string& path);

  struct Values {
    double force, slope;  ///< at a point, the slope to its right
  };
  Values operator()(double x) const;
  /// Integral of the force from 0 to x.
  double energy(double x) const { return integral(x) - at_zero_; }
  double first() const { return x_.front(); }
  double last() const { return x_.back(); }

 private:
  ForceCurve(std::vector<double> x, std::vector<double> force);
  std::size_t piece(double x) const;
  double integral(double x) const;  ///< integral from the first point
  std::vector<double> x_, force_, slope_, area_;
  double at_zero_ = 0;
};

}  // namespace bielle::mechanism
