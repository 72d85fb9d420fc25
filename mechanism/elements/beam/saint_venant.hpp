// Saint-Venant's problems of torsion and flexure on a cross section made of rectangles, by finite elements.
//
// The coordinates y and z are from the centroid, and the shear modulus is G = 1.
// clang-format off
//     torsion by a unit twist rate:   tau = grad omega + (-z, y),   div tau = 0,
//     flexure by a shear force V:     tau = grad Phi,   div tau = -c.(y,z),   [I_z I_yz; I_yz I_y] c = V,
// clang-format on
// The boundary condition is tau.n = 0.
// Flexure is that without lateral contraction (Poisson's ratio 0), whose stresses do no work on the twist: the
// section's compliance for the shear forces and the torque about the shear centre has no coupling terms,
//     J = int |tau|^2,   F_ij = int grad Phi_i . grad Phi_j,   shear centre from int (y tau_z - z tau_y).
// The elements are biquadratic, on a grid that is graded towards the corners. J is overestimated, F underestimated; the
// error, measured by finer grids, is below 2e-4. In a wall of thickness t in a section of size h the stress, of the
// size t, is a small difference of warping functions of the size h^2: these are computed by iterative refinement with
// residuals from the stresses of the elements in extended precision, down to t/h = 1e-5 (`thinnest_part`).
// In a re-entrant corner without fillet the exact stresses are infinite; those of the elements, which are returned
// there, grow with the refinement of the grid and have no meaning. References: S. Timoshenko, J. Goodier, Theory of
// Elasticity, ch. 10 and 11; F. Gruttmann, W. Wagner, Comput. Mech. 27 (2001) 199.
#pragma once

#include <array>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// An axis-parallel rectangle [y0, y1] x [z0, z1] [m].
struct SectionRectangle {
  double y0, y1, z0, z1;
};

/// Union of rectangles, with its moments of area; y and z are measured from the centroid.
struct RectangleArea {
  /// @param parts  rectangles without overlap, joined along edges
  explicit RectangleArea(std::vector<SectionRectangle> parts);

  std::vector<SectionRectangle> rectangles;  ///< relative to the centroid
  double area = 0;                           ///< [m^2]
  Vector2 centroid = Vector2::Zero();        ///< in the coordinates of the given rectangles [m]
  Matrix2 I = Matrix2::Zero();               ///< [int y^2, int y z; int y z, int z^2] [m^4]

  bool contains(const Vector2& point) const;  ///< boundary included
  double tolerance() const;                   ///< lengths [m] below this are rounding
  /// Returns the smallest distance of two edges of rectangles along y or z, relative to the larger side of the whole.
  double thinnest_part() const;
};

/// Fineness of the grid: size of the cells at a corner relative to the thinnest wall, and growth factor from cell to
/// cell.
struct SectionGrid {
  double first = 1.0 / 32, growth = 1.6;
};

class SaintVenant {
 public:
  /// Walls (and parts that project from them) down to this fraction of the section's size are accurate.
  static constexpr double thinnest_part = 1e-5;

  /// @throws ComputationError if rounding makes the solution inaccurate, for parts far thinner than `thinnest_part`
  explicit SaintVenant(const RectangleArea& area, const SectionGrid& grid = {});

  double J() const { return J_; }                                ///< torsion constant [m^4]
  const Matrix2& shear_compliance() const { return F_; }         ///< F [1/m^2]: strains per force are F/G
  const Vector2& shear_centre() const { return shear_centre_; }  ///< position relative to the centroid [m]

  /// Returns shear stresses (tau_xy, tau_xz) [Pa] (rows) due to unit shear forces V_y, V_z at the shear centre [1/m^2]
  /// and to a unit torque about it [1/m^3] (columns), at a point relative to the centroid; on the boundary between
  /// elements it is the mean of both.
  /// @throws std::domain_error outside of the section
  Eigen::Matrix<double, 2, 3> shear_stress(const Vector2& point) const;

 private:
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  using Stresses = Eigen::Matrix<double, 2, 3>;
  struct Cell {
    double y0, y1, z0, z1;
    std::array<int, 9> node;
  };
  /// Differences of the fields at a cell's nodes from those at the first node of the same row (along y) or column
  /// (along z): in long and flat cells the differences across are much smaller.
  struct Differences {
    Eigen::Matrix<double, 9, 3> along_y, along_z;
  };
  void make_grid(const RectangleArea& area, const SectionGrid& grid);
  void solve(const RectangleArea& area);
  /// Computes J, F and the shear centre from the present fields.
  /// @returns residuals of the weak forms (rows: nodes)
  Eigen::Matrix<double, Eigen::Dynamic, 3> evaluate(const Matrix2& I_inverse);
  Differences differences(const Cell& cell) const;
  /// Stresses of the three problems (rows y, z). @param v_u,v_w  slopes of the shape functions at the point
  static Stresses stresses(const Cell& cell, const Differences& differences, const Vector9& v_u, const Vector9& v_w,
                           const Vector2& place);

  double J_ = 0, tolerance_ = 0;
  Vector2 shear_centre_ = Vector2::Zero();
  Matrix2 F_ = Matrix2::Zero();
  std::vector<Cell> cells_;
  int nodes_ = 0;
  /// Phi_y, Phi_z, omega at the nodes; in extended precision, because their gradients are small differences
  Eigen::Matrix<long double, Eigen::Dynamic, 3> field_;
};

}  // namespace bielle::mechanism
