// Stiffness and mass of a body as another program computed them, full or reduced, from a matrix file (README.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reduce/superelement/recovered_quantity.hpp"

namespace bielle::reduce {

using SparseColumns = Eigen::SparseMatrix<double>;

/// An unknown of the matrices: a displacement or rotation of a node in the node's axes, or a scalar coordinate, such as
/// the amplitude of a mode.
struct NodalUnknown {
  int node = -1;      ///< index of the node; -1 for a scalar
  int component = 0;  ///< 0 to 5: x y z rx ry rz; the count of a scalar

  bool is_scalar() const { return node < 0; }
  bool is_rotation() const { return node >= 0 && component >= 3; }
};

/// Displacements inside the body as functions of the unknowns.
struct NodalShapes {
  std::vector<std::int64_t> numbers;      ///< (p) numbers of the points in the file
  Eigen::Matrix3Xd points;                ///< (3,p) [m]
  Eigen::MatrixXd displacement;           ///< (3p,n): rows x y z of the first point, of the second ..., body axes
  Eigen::MatrixXd rotation;               ///< (3p,n) the same for rotations; empty: not known
  Eigen::VectorXd masses;                 ///< (p) point masses whose sum is the mass of the body [kg]; empty: not known
  std::vector<Eigen::Matrix3d> inertias;  ///< (p) about the points, body axes [kg m^2]; empty: none
  std::map<int, Eigen::MatrixXi> cells;   ///< by gmsh element type: nodes per cell x cells, indices of points
  Eigen::MatrixXd stress;                 ///< (6s,n): xx yy zz yz xz xy at some points, body axes; empty: not known
  std::vector<int> stress_points;         ///< (s) indices of these points
};

/// Mass properties that a file states besides its matrices.
struct StatedMass {
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, body axes [kg m^2]
};

/// Matrices over n unknowns in SI units. They are as the file has them, not necessarily symmetric.
struct MatrixSet {
  std::string name;                    ///< name of the body
  std::string source;                  ///< format and file, for messages
  bool has_units = false;              ///< whether the file or the user declared the units of the numbers
  std::vector<std::int64_t> numbers;   ///< numbers of the nodes in the file
  Eigen::Matrix3Xd positions;          ///< (3,nodes) body axes [m]
  std::vector<Eigen::Matrix3d> axes;   ///< of each node: axes of its unknowns -> body axes
  std::vector<NodalUnknown> unknowns;  ///< (n)
  SparseColumns stiffness, mass;
  SparseColumns damping, geometric_stiffness;         ///< (0,0) if the file has none
  std::map<std::string, int> interfaces;              ///< nodes that the file itself declares as interfaces, by name
  std::array<Eigen::MatrixXd, 6> inertia_components;  ///< S_11 S_22 S_33 S_23 S_13 S_12; empty if the file has none
  std::optional<StatedMass> stated;
  std::optional<NodalShapes> shapes;
  std::map<int, Eigen::MatrixXi> cells;  ///< between nodes, for drawings: as NodalShapes::cells, indices of nodes
  RecoveredQuantities quantities;        ///< further numbers in terms of the unknowns

  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns.size()); }
  Eigen::Index scalars() const;
  /// "node 12 rx" or "scalar 3", for messages.
  std::string name_of(Eigen::Index unknown) const;
};

/// Tells whether an HDF5 file is a matrix file by its attribute `format`.
bool holds_matrices(const std::string& path);
/// Reads a matrix file. @throws InputError `file: ...` if it is none, or if its parts do not fit together
MatrixSet read_matrix_set(const std::string& path);

/// Largest absolute value in the row and the column of each unknown.
Eigen::VectorXd largest_entries(const SparseColumns& matrix);

/// Unknowns without any stiffness and mass, which programs leave in full matrices: they are taken out.
/// @returns their number
Eigen::Index remove_empty_unknowns(MatrixSet& set);

/// Returns a square of a frequency that serves as a scale [rad^2/s^2], by the ratios of the diagonals: the least one of
/// the scalars, otherwise the median of the unknowns; 0 if no unknown has both stiffness and mass.
double reference_eigenvalue(const MatrixSet& set);

/// Clears rows and columns of the stiffness that consist of rounding errors. The interfaces of a body that is held
/// statically determinate have such rows: with their own mass they would vibrate at less than 1e-4 of a frequency of
/// the body.
void clear_rounding(MatrixSet& set);

/// Displacements or rotations of all nodes in body axes, in terms of the unknowns: (3 nodes, n), rows x y z of the
/// first node, of the second ... A component without an unknown is zero.
SparseColumns nodal_motions(const MatrixSet& set, bool rotations);

/// Rigid motions of the unknowns of nodes (n,6): unit translations along the body's axes, unit rotations about axes
/// through `about`. Scalars have zeros.
Eigen::MatrixXd nodal_rigid_motions(const MatrixSet& set, const Eigen::Vector3d& about);

}  // namespace bielle::reduce
