// What a superelement is good for, as its reduction measured it on the mesh. Estimates for the reader, no part of the
// model: a mechanism does not need them, and files may lack them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

struct Adequacy {
  /// Free-free frequencies of the reduced body that were examined, the lowest ones, ascending [Hz].
  Eigen::VectorXd frequencies;
  /// (as `frequencies`) by what part of itself each is higher than that of the mesh with the same ties, since modes are
  /// left out: from the answer of the modes left out to the mode's residual.
  Eigen::VectorXd mode_error;
  /// (the first of `frequencies`) by what part of itself each is higher than with a fine mesh: Zienkiewicz and Zhu.
  Eigen::VectorXd mesh_error;
  /// (the first of `frequencies`) by what part of itself each is at least higher than with average ties in place of the
  /// rigid ones. Empty without rigid ties.
  Eigen::VectorXd tie_error;
  /// (directions) relative error of the stress in the energy norm for a unit load on each kept direction of the
  /// interfaces, the body free; empty when there are too many directions.
  Eigen::VectorXd stress_error;
  Eigen::Vector3d worst_place = Eigen::Vector3d::Zero();  ///< where the error of stress is largest, body axes [m]
  /// Share 0..1 of the held body's answer to constant accelerations along x y z, body axes, that the modes have.
  Eigen::Vector3d inertia_answer = Eigen::Vector3d::Ones();

  double next_mode = 0;          ///< of the first fixed-boundary mode left out [Hz]; 0: not sought, or there is none
  double wanted = 0;             ///< `modes.below` of the body file [Hz]; 0: not given
  int order = 2;                 ///< of the elements
  double one_element_thick = 0;  ///< share 0..1 of the surface below which the body is one element thick
  double least_jacobian = 1;     ///< least scaled Jacobian of the elements
  std::vector<std::string> rigid_ties;  ///< names of the interfaces with rigid ties
};

}  // namespace bielle
