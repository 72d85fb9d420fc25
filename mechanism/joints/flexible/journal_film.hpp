// Pressure in the cavitated film of a journal bearing, for the short bearing and for bearings of finite length.
//
// With the film thickness h = c - x cos(Theta) - y sin(Theta) (x, y: displacement of the journal, c: radial clearance),
// the speed of the shaft w relative to the bush, lengths L and radius R, Reynolds' equation is
//     1/R^2 d/dTheta (h^3 dp/dTheta) + h^3 d2p/dz2 = -6 mu b,   b = B . [cos(Theta), sin(Theta)],
//     B = 2 [xdot, ydot] + w [y, -x],
// Two conditions at the edges of the film:
//     half      pressure on the half of the circumference on which b > 0, p = 0 on the other half and at its ends,
//     reynolds  p >= 0, and pressure and its slope vanish at the edges, where they are (reynolds_film.hpp).
// With s from the middle of the film along u = B/|B|, h = c (1 - a cos s - d sin s), the force on the bush
// is
//     N = k (W_1(a, d) B + W_2(a, d) B'),   k = mu R L^3/(2 c^3),   B' = [-B_y, B_x].
// Short bearing (DuBois, Ocvirk): the pressure's derivative along the circumference is neglected,
//     W = int [cos s, sin s] cos s/(1 - a cos s - d sin s)^3 ds over |s| < pi/2.
// Finite length: the first terms of the cosine series of the pressure along z (three, and four more per L/D), each the
// solution of an ordinary differential equation in s by finite differences; the remaining terms, less than 0.1 % of the
// force, are those of the short bearing. With Reynolds' condition, they do not separate: a map of the difference to the
// half film is added (film_map.hpp). The pressure of short bearings is local, and the same with both. Reference: A. Z.
// Szeri, Fluid Film Lubrication (Cambridge, 2011), chapters 3 and 4.
#pragma once

#include <memory>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class FilmMap;
enum class Cavitation { half, reynolds };

class JournalFilm {
 public:
  /// @param slenderness  L/(2 R) of a bearing of finite length; 0: a short bearing
  explicit JournalFilm(double slenderness, Cavitation cavitation = Cavitation::half);
  struct Shape {
    Vector2 W;         ///< W_1, W_2
    Matrix2 gradient;  ///< by a and d
  };
  /// @pre a^2 + d^2 < 1
  Shape shape(double a, double d) const;

 private:
  double slenderness_;
  std::shared_ptr<const FilmMap> map_;  // null: the half film
};

}  // namespace bielle::mechanism
