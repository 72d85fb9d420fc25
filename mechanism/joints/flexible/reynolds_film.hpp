// Force of a film of finite length with Reynolds' condition at its edges: no pressure is negative, and pressure and its
// slope vanish wherever the film ends (Swift, Stieber).
//
// With lengths in radii, h = 1 - a cos s - d sin s (journal_film.hpp) and the pressure p in 6 mu |B| R^2/c^3,
//     p >= 0,   f = (h^3 p_s)_s + (h^3 p_z)_z + cos s <= 0,   p f = 0:
// an obstacle problem, whose solution is unique and depends continuously on a and d. The film begins and ends where
// this says; nothing else holds its beginning. Its force W (journal_film.hpp) is
//     W = 12/(L/R)^3 int p [cos s, sin s] ds dz.
// Finite volumes over the circumference and half of the length (symmetry in the middle, p = 0 at the end), whose nodes
// are the denser along s the narrower the gap is, and are those of Chebyshev along z. The wet cells are found by the
// primal-dual active set method, from coarser grids, so that the result is a function of the arguments alone.
// References: G. Capriz, G. Cimatti, Free boundary problems in the theory of hydrodynamic lubrication (1983); M.
// Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2003) 865.
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

struct FilmGrid {
  int around = 160;  ///< cells of the circumference, a multiple of 4
  int along = 10;    ///< cells of half of the length
};

/// Returns W of the film with Reynolds' condition, to 0.3 % for a^2 + d^2 < 0.99^2 with the standard grid.
/// @pre a^2 + d^2 < 1
Vector2 reynolds_film(double a, double d, double slenderness, const FilmGrid& grid = {});

}  // namespace bielle::mechanism
