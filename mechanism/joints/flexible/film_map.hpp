// The difference of two cavitated films of finite length, with Reynolds' condition (reynolds_film.hpp) and the half
// film (journal_film.hpp), as a smooth function of a and d.
//
// One solution of Reynolds' condition takes about a millisecond, and its derivatives jump by the size of a cell where
// cells fall dry. A map replaces it: with e^2 = a^2 + d^2 and [X, Y] = [a, d]/sqrt(1 - e^2),
//     W = W_half + |W_half| D(asinh X, asinh Y),
// D being a bicubic spline on a square grid. At any eccentricity D changes over lengths of about 1 in X and Y, since a
// peak of pressure has the width sqrt(1 - e). Beyond the last node, e = 0.995, D stays as it is there. Error of the
// spline: 0.05 % of the force for e < 0.95, 0.5 % at 0.99.
#pragma once

#include <array>
#include <memory>

#include "mechanism/math/types.hpp"
#include "reduce/common/autodiff.hpp"

namespace bielle::mechanism {

class FilmMap {
 public:
  using Jet = AutoDiff<2, 1>;
  /// Returns the map of this slenderness, which is made once in a process.
  static std::shared_ptr<const FilmMap> of(double slenderness);
  explicit FilmMap(double slenderness);
  /// Returns D with its derivatives by a and d.
  /// @pre a^2 + d^2 < 1
  std::array<Jet, 2> difference(double a, double d) const;

 private:
  std::array<MatrixX, 2> coefficients_;  // coefficients of cubic B-splines, by X and Y
};

}  // namespace bielle::mechanism
