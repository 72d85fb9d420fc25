// Contribution of ties to the geometric stiffness: the second-order displacement of tied surfaces and of the arms to
// their nodes.
//
// Per interface, with theta (3,n) the rotation of its surface in terms of q, body axes:
//     rigid     theta^T [sym(N) - tr(N) I] theta,  N = sum over nodes f_s (X_s - X)^T,  f_s the force of the tie on
//     node s average   theta^T [tr(F a^T) I - sym(F a^T) + sym(w~ S)] theta,  a = X - X_c,  w = J_A^-1 (M + a x F),
//               S = int r r^T dA, and of the surface's deformation, D = int u r^T dA - theta~ S with u its displacement
//               from the centroid's: twice the symmetric part of -w.(D^T theta - theta tr D)
// with F, M the load on that interface. A mass on a surface is a cloud of average ties, one for each of its elements,
// with the inertia force of the element. The rotation is taken for the rotation vector, while an interface that
// releases the turn about one axis d has the coordinates t = d x (E d) of the mechanism (the node may spin): of these
//     m.t = m.theta + (d.theta) (m.(d x theta)) / 2 + ..  for a kept moment direction m,
// and the load m also contributes -(psi^T b + b^T psi) / 2, psi = d^T theta, b = m^T d~ theta. A single kept rotation
// needs no correction: its coordinate is the rotation vector's component to second order.
#pragma once

#include <vector>

#include "reduce/reduction/added_masses.hpp"
#include "reduce/reduction/basis.hpp"

namespace bielle::reduce {

/// A load of the free body on an interface, body axes; interface -1: none.
struct InterfaceLoad {
  int interface = -1;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};

/// Acceleration a0 + A (x - centre), body axes [m/s^2 per unit of a load].
struct LinearAcceleration {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
};

class TieSecondOrder {
 public:
  /// The object keeps references to all arguments.
  TieSecondOrder(const Solid& solid, const Ties& ties, const AddedMasses& masses, const Basis& basis);

  /// Adds the terms of all interfaces to the geometric stiffness of one field.
  /// @param tie_forces  (3 points, fields): forces of rigid ties on the nodes
  void add(const RowMatrix& tie_forces, Eigen::Index field, const InterfaceLoad& load, Eigen::MatrixXd& k) const;

  /// Adds the terms of the masses' inertia forces under an acceleration.
  void add_masses(const LinearAcceleration& acceleration, Eigen::MatrixXd& k) const;

  /// theta of each interface (3,n), body axes; zero for free ties.
  const std::vector<Eigen::MatrixXd>& rotations() const { return rotations_; }

 private:
  /// theta and D of a surface.
  struct MeanMotion {
    Eigen::MatrixXd rotation, deformation;
  };
  static MeanMotion mean_motion(const SurfaceIntegrals& surface, const Basis& basis);
  static void add_deformation(const Eigen::Vector3d& w, const Eigen::MatrixXd& rotation, const Eigen::MatrixXd& d,
                              Eigen::MatrixXd& k);
  Eigen::Matrix3d rotation_term(const RowMatrix& tie_forces, Eigen::Index field, const InterfaceLoad& load,
                                std::size_t number) const;
  void add_deformation(const InterfaceLoad& load, Eigen::MatrixXd& k) const;
  void add_release(const InterfaceLoad& load, Eigen::MatrixXd& k) const;

  const Solid& solid_;
  const Ties& ties_;
  const AddedMasses& masses_;
  std::vector<Eigen::MatrixXd> rotations_;
  std::vector<Eigen::MatrixXd> deformations_;  ///< for average ties: rows D_00 D_10 D_20 D_01 .. (9,n)
  std::vector<MeanMotion> of_masses_;
};

}  // namespace bielle::reduce
