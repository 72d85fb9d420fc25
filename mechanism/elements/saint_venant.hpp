// Saint-Venant's problems of torsion and flexure on a cross section made of rectangles, by finite elements.
//
// With y and z from the centroid and the shear modulus G = 1,
//     torsion by a unit twist rate:   tau = grad omega + (-z, y),   div tau = 0,
//     flexure by a shear force V:     tau = grad Phi,   div tau = -c.(y,z),   [I_z I_yz; I_yz I_y] c = V,
// and tau.n = 0 on the boundary.
// Flexure is that without lateral contraction (Poisson's ratio 0), whose stresses do no work on the twist: the
// section's compliance in the shear forces and in the torque about the shear centre has no coupling terms,
//     J = int |tau|^2,   F_ij = int grad Phi_i . grad Phi_j,   shear centre from int (y tau_z - z tau_y).
// Biquadratic elements on a grid that is graded towards the corners. J comes out too large, F too small; the error,
// measured against finer grids, is below 2e-4. Stresses are those of the elements; in a re-entrant corner without
// fillet they are infinite, and what is given there means nothing. References: S. Timoshenko, J. Goodier, Theory of
// Elasticity, ch. 10 and 11; F. Gruttmann, W. Wagner, Comput. Mech. 27 (2001) 199.
#pragma once

#include <array>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

/// An axis-parallel rectangle [y0, y1] x [z0, z1] [m].
struct SectionRectangle {
  double y0, y1, z0, z1;
};

/// How fine the grid is: cells at a corner over the thinnest wall, and the growth from cell to cell.
struct SectionGrid {
  double first = 1.0 / 32, growth = 1.6;
};

class SaintVenant {
 public:
  /// @param rectangles  without overlap, joined along edges; their common centroid becomes the origin
  explicit SaintVenant(std::vector<SectionRectangle> rectangles, const SectionGrid& grid = {});

  double area() const { return area_; }                          ///< [m^2]
  const Vector2& centroid() const { return centroid_; }          ///< in the coordinates of the rectangles given [m]
  double I_y() const { return I_(1, 1); }                        ///< integral of z^2 [m^4]
  double I_z() const { return I_(0, 0); }                        ///< of y^2
  double I_yz() const { return I_(0, 1); }                       ///< of y z
  double J() const { return J_; }                                ///< torsion constant [m^4]
  const Matrix2& shear_compliance() const { return F_; }         ///< F [1/m^2]: strains per force are F/G
  const Vector2& shear_centre() const { return shear_centre_; }  ///< from the centroid [m]

  bool contains(const Vector2& point) const;  ///< a point from the centroid, boundary included
  /// Shear stresses (tau_xy, tau_xz) [Pa] (rows) of unit shear forces V_y, V_z at the shear centre [1/m^2] and of a
  /// unit torque about it [1/m^3] (columns), at a point from the centroid; between elements their mean.
  /// @throws std::domain_error outside of the section
  Eigen::Matrix<double, 2, 3> shear_stress(const Vector2& point) const;

 private:
  struct Cell {
    double y0, y1, z0, z1;
    std::array<int, 9> node;
  };
  void integrate_area(const std::vector<SectionRectangle>& rectangles);
  void make_grid(const std::vector<SectionRectangle>& rectangles, const SectionGrid& grid);
  void solve();
  double cell_torsion(const Cell& cell) const;
  bool holds(const Cell& cell, const Vector2& point) const;
  /// Gradients (rows y, z) of the three fields at a place (u, w) in [0, 1]^2 of a cell.
  Eigen::Matrix<double, 2, 3> gradient(const Cell& cell, double u, double w) const;

  double area_ = 0, J_ = 0;
  Vector2 centroid_ = Vector2::Zero(), shear_centre_ = Vector2::Zero();
  Matrix2 I_ = Matrix2::Zero(), F_ = Matrix2::Zero();
  std::vector<Cell> cells_;
  int nodes_ = 0;
  double tolerance_ = 0;                            ///< [m]
  Eigen::Matrix<double, Eigen::Dynamic, 3> field_;  ///< Phi_y, Phi_z, omega at the nodes
};

}  // namespace bielle::mechanism
