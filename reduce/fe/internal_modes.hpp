// Internal displacement modes of cells of order 1, without which they would lock in bending. Internal to reduce/fe.
//
// hex8 has the modes 1 - xi_k^2 along each coordinate, wedge6 that along its height and the products l_a l_b of its
// triangle, in three directions each. (They have no mean strain. wedge6 stays stiff in bending: the mean strain within
// its triangles, and the mean shear across them, are those of linear functions. Patch tests next to cells of other
// types require that: they prescribe the nodal forces of a constant stress, hence at least the energy of that mean
// strain. Shear tied at the middles of edges, as in MITC3, removes the stiffness across the triangles, but changes
// these forces: sums over the wedges around a node vanish in layers with parallel triangles alone.) They belong to the
// cell alone and are condensed: their amplitudes follow from the displacements u of the nodes,
//     alpha = -K_aa^-1 K_au u,   strain = (B - G K_aa^-1 K_au) u.
// The strains G of the modes are made from local gradients without mean, with the Jacobian J_0 in the middle of the
// cell and the factor det J_0 / det J: their integral vanishes, and the patch test is passed on any mesh. Reference: R.
// L. Taylor, P. J. Beresford, E. L. Wilson, A non-conforming element for stress analysis, Int. J. Numer. Meth. Engng 10
// (1976) 1211-1219.
#pragma once

#include <Eigen/Core>

#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/elasticity.hpp"

namespace bielle::reduce {

/// `set` and `strain` exist for cells that have such modes, and are compiled once.
template <int N>
class InternalModes {
 public:
  static constexpr int functions = N == 8 ? 3 : N == 6 ? 4 : 0;
  static constexpr bool any = functions > 0;
  static constexpr int count = 3 * functions;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Strain = Eigen::Matrix<double, 6, 3 * N>;

  explicit InternalModes(Integration integration)
      : active_(any && integration != Integration::plain),
        rule_(cell_quadrature(SolidCell<N>::type, stiffness_degrees<N>().curved)),
        middle_(shape_gradients(SolidCell<N>::type,
                                N == 6 ? Eigen::Vector3d(1.0 / 3, 1.0 / 3, 0) : Eigen::Vector3d(0, 0, 0))) {}

  bool active() const { return active_; }

  /// Condenses the modes of a cell that is nowhere inverted.
  void set(const CellPoints<N>& x, const Matrix6& elasticity);

  /// K_ua times the amplitudes by displacements: added to the stiffness of the displacements alone, (3 N, 3 N).
  const Eigen::Matrix<double, 3 * N, 3 * N>& condensed() const { return condensed_; }

  /// Strain at a point, with the modes. @param local  the point in the reference cell
  /// @param determinant  determinant of the Jacobian there
  Strain strain(const Eigen::Matrix<double, N, 3>& gradients, const Eigen::Vector3d& local, double determinant) const;

 private:
  using Modes = Eigen::Matrix<double, 6, count>;
  using Gradients = Eigen::Matrix<double, functions, 3>;

  static Gradients local_gradients(const Eigen::Vector3d& local);
  Modes strains(const Eigen::Vector3d& local, double determinant) const;

  bool active_;
  CellRule<N> rule_;
  Eigen::Matrix<double, N, 3> middle_;
  Eigen::Matrix3d inverse_;
  double determinant_ = 0;
  Eigen::Matrix<double, count, 3 * N> amplitudes_;
  Eigen::Matrix<double, 3 * N, 3 * N> condensed_;
};

/// Sets A eps at all points of a rule in a cell, with its internal modes if they are active. @param A_of  (volume of
/// the point) -> (6, 6)
/// @param visit  (point, gradients, volume), called before
template <int N, class Matrices, class Visit>
void set_strains(CellFields<N>& cell, InternalModes<N>& modes, const CellRule<N>& rule, const CellPoints<N>& x,
                 const Eigen::Matrix<double, 6, 6>& elasticity, const Matrices& A_of, const Visit& visit) {
  Eigen::Matrix<double, N, 3> gradients;
  if constexpr (InternalModes<N>::any)
    if (modes.active()) modes.set(x, elasticity);
  for (std::size_t p = 0; p < rule.size(); ++p) {
    const auto point = static_cast<Eigen::Index>(p);
    const double volume = map_point<N>(rule, p, x, gradients);
    visit(point, gradients, volume);
    if constexpr (InternalModes<N>::any)
      if (modes.active()) {
        cell.set_strain(point, A_of(volume),
                        modes.strain(gradients, rule.points.col(point), volume / rule.weights(point)));
        continue;
      }
    cell.set_point(point, A_of(volume), gradients);
  }
}

}  // namespace bielle::reduce
