// The inertia components S_kl of foreign matrices, from which a mechanism computes the inertia of large rotations.
//
// They do not follow from M~ alone: S_kl = integral of rho u_k u_l depends on the directions of the motion inside. They
// are taken from the first of these sources that exists:
//   the file      where it has them;
//   its shapes    with point masses: S_kl = sum over points of m u_k u_l, rotary inertia as a cloud of mass;
//   the nodes     a block of M between two nodes is that of mass at rigid clouds around them. With unknowns of a
//                 displacement field it is m I exactly (nodal-based inertia: A. Zwoelfer, J. Gerstmayr, "A concise
//                 nodal-based derivation of the floating frame of reference formulation for displacement-based solid
//                 finite elements", Multibody Syst. Dyn. 49 (2020) 291);
//   an estimate   for reduced matrices. The rigid part is that of M~ (rigid_split.hpp). The rest has the directions of
//   the
//                 nodes, or of shapes without masses, as far as these explain its energy; each direction gets a third
//                 of what remains. Moments that change the inertia to first order are those that the interfaces show
//                 (shown_moments.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

enum class InertiaSource { file, shapes, nodes, nearly_nodes, equal_masses, estimate };

struct BodyInertia {
  std::array<Eigen::MatrixXd, 6> components;  ///< S_11 S_22 S_33 S_23 S_13 S_12, (N,N)
  InertiaSource source = InertiaSource::file;
  /// Largest share of the kinetic energy of a free elastic mode whose direction is not known, 0 to 1.
  double unknown_share = 0;
  std::array<double, 6> shown{};  ///< shares of an estimate, as in ShownMoments
  std::string told() const;       ///< a sentence or two for the user
};

/// @param shapes  T (n,N): the unknowns in terms of the reduced coordinates
/// @param mass    M~ (N,N) @param rigid  U (N,6) rigid motions about the centre
/// @param modes   (N, free elastic modes) of the reduced body
BodyInertia body_inertia(const MatrixSet& set, const Eigen::MatrixXd& shapes, const std::vector<Interface>& interfaces,
                         const Eigen::MatrixXd& mass, const MassProperties& body, const Eigen::MatrixXd& rigid,
                         const Eigen::MatrixXd& modes);

/// S_kl of point masses with inertia. @param displacement  (3p,N) @param rotation  (3p,N) or empty
std::array<Eigen::MatrixXd, 6> inertia_of_points(const NodalShapes& points, const Eigen::MatrixXd& displacement,
                                                 const Eigen::MatrixXd& rotation);

/// S_kl of the nodes' blocks of M. @param shapes  T (n,N) @param rotations  whether to count blocks of rotations
std::array<Eigen::MatrixXd, 6> inertia_of_nodes(const MatrixSet& set, const Eigen::MatrixXd& shapes,
                                                bool rotations = true);

}  // namespace bielle::reduce
