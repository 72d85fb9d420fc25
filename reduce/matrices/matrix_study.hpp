// Quantities that several subjects of the verification of matrices share: symmetric parts, scales, three kinds of rigid
// motions, and the lowest modes of the free body.
//
// Geometric rigid motions follow from positions and axes of nodes; scalars follow statically, -K_ss^-1 K_sn u_n. A body
// whose unknowns are scalars alone has those that its shapes fit best. Static ones hold a set r of six unknowns and
// move them one by one, u = [1; -K_ll^-1 K_lr]: they follow from the stiffness alone, and the forces at r vanish in a
// free body. The third kind are the six lowest modes. (pyYeti's cbcheck and coordinate checks of Nastran compare the
// same kinds.)
#pragma once

#include <optional>
#include <string>

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/matrices/set_algebra.hpp"

namespace bielle::reduce {

struct MatrixStudy {
  const MatrixSet& set;
  int threads = 1;
  SparseColumns stiffness, mass;                     ///< symmetric parts
  double length = 1;                                 ///< diagonal of the box of nodes and points [m]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of that box; geometric rotations turn about it [m]
  std::optional<Eigen::MatrixXd> geometric;          ///< (n,6) unit translations x y z, unit rotations rx ry rz
  std::string no_geometric;                          ///< the reason if there are none
  Unknowns references;                               ///< six unknowns whose values determine a rigid motion
  std::optional<Eigen::MatrixXd> statical;           ///< (n,6) one for each reference
  std::string no_statical;                           ///< the reason if there are none
  std::optional<NaturalModes> modes;                 ///< the lowest, rigid ones included
  std::string no_modes;                              ///< the reason if there are none

  Eigen::Index size() const { return set.size(); }
  /// Displacements of nodes, and their rotations times `length`; of a body without nodes the displacements of its
  /// points. Motions are compared in these.
  Eigen::MatrixXd observed(const Eigen::MatrixXd& motions) const;
  /// Forces K u relative to sqrt(k_ii) max_j sqrt(k_jj) |u_j|, which is their size without cancellation and does not
  /// depend on units: (n, motions).
  Eigen::MatrixXd relative_forces(const Eigen::MatrixXd& motions) const;
};

/// Number of elastic modes that are sought.
inline constexpr int elastic_modes = 20;

/// @param set  must outlive the study; without empty unknowns (remove_empty_unknowns)
MatrixStudy study_matrices(const MatrixSet& set, int threads);

}  // namespace bielle::reduce
