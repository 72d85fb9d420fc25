// Physical checks of a reduced body that need only its superelement, so that they can be repeated on a file.
#pragma once

#include <string>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// A number with its expected value.
struct Check {
  std::string name;     ///< name in the file, e.g. "rigid_motion_force"
  double value = 0;     ///< dimensionless error unless the meaning says otherwise
  double limit = 0;     ///< passed when value <= limit
  std::string meaning;  ///< one sentence for the summary

  bool passed() const { return value <= limit; }
};

/// @param what  "the reduced body" @throws ComputationError when a check failed
void fail_when_a_check_does(const std::vector<Check>& checks, const std::string& what);

/// Runs all checks of a superelement: rigid motions in the kernel of K~, positive energy, mass properties of M~ against
/// those of the mesh, the inertia components, normalised modes, recovery of rigid motions without stress, and the
/// geometric stiffness under rigid rotations against the virial of loads and inertia.
std::vector<Check> check_superelement(const Superelement& body);

/// Largest force (K u)_i of some motions u in units of sqrt(K_ii) max_j sqrt(K_jj) max_j |u_j|, its size without
/// cancellation, with coordinates scaled to unit mass. @param mass  used for that scale only
double relative_force(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& motions);

/// U in all n coordinates (n,6), rotations about a point; rigid motions have no component in fixed-boundary modes.
Eigen::MatrixXd rigid_coordinates(const Superelement& body, const Eigen::Vector3d& about);
/// Mass properties as integrated on the mesh.
MassProperties mass_properties(const Superelement& body);

/// Mass, centre and inertia of M~ under rigid motions U: entries of U^T M~ U.
struct ReducedMassProperties {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre
};
ReducedMassProperties reduced_mass_properties(const Superelement& body);

/// Natural frequencies of the free reduced body, ascending, without the rigid motions [Hz].
Eigen::VectorXd free_frequencies(const Superelement& body);

}  // namespace bielle::reduce
