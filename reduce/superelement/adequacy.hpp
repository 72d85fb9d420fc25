// The accuracy of a superelement, which its reduction measured on the mesh. The estimates inform the reader and are no
// part of the model: a mechanism does not need them, and files may lack them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

struct Adequacy {
  /// Examined free-free frequencies of the reduced body, the lowest ones, ascending [Hz].
  Eigen::VectorXd frequencies;
  /// (as `frequencies`) relative excess of each over that of the mesh with the same ties because of omitted modes, from
  /// the answer of the omitted modes to the mode's residual.
  Eigen::VectorXd mode_error;
  /// (as `frequencies`) modal assurance criterion of each shape with that of the mesh, in the metric of the mass: 1 for
  /// equal shapes. It is empty in files that were written without it.
  Eigen::VectorXd mode_mac;
  /// (the first of `frequencies`) relative excess of each over that of a fine mesh (Zienkiewicz and Zhu).
  Eigen::VectorXd mesh_error;
  /// (the first of `frequencies`) least relative excess of each over that with average ties in place of the rigid ones.
  /// It is empty if there are no rigid ties.
  Eigen::VectorXd tie_error;
  /// (directions) relative error of the stress in the energy norm for a unit load on each kept direction of the
  /// interfaces of the free body; empty if there are too many directions.
  Eigen::VectorXd stress_error;
  Eigen::Vector3d worst_place = Eigen::Vector3d::Zero();  ///< place of the largest error of stress, body axes [m]
  /// Share 0..1 of the modes in the held body's answer to constant accelerations along x y z, body axes.
  Eigen::Vector3d inertia_answer = Eigen::Vector3d::Ones();

  double next_mode = 0;          ///< frequency of the first omitted fixed-boundary mode [Hz]; 0: not sought, or there
                                 ///< is none
  double wanted = 0;             ///< `modes.below` of the body file [Hz]; 0: not given
  int order = 2;                 ///< 1: elements of order 1 that lock in bending; 2: all others, hex8 included
  double one_element_thick = 0;  ///< share 0..1 of the surface below which the body is one element thick
  double least_jacobian = 1;     ///< least scaled Jacobian of the elements
  std::vector<std::string> rigid_ties;  ///< names of the interfaces with rigid ties
};

}  // namespace bielle
