// The frame (x_0, R_0) of a deformed body, defined by six conditions on its interfaces, and the local coordinates q in
// it.
//
// q contains for each interface u_i = y_i - X_i, y_i = R_0^T (x_i - x_0), then (if its rotations act) t_i(E_i), E_i =
// R_0^T R_i R_ref,i^T, see interface_rotation.hpp; after all interfaces the modal amplitudes eta. All of them are
// vectors in body axes, for any directions kept by the interface: the matrices of the body are zero in directions that
// are not kept.
//
// Conditions:  A^T q = 0,   A = W U,   U: rows u_i [I, -X_i~], t_i [0, I], eta 0 (rigid motions), with any weights W
// for which A^T U is regular, see frame_conditions.hpp. The frame is a function of the present positions only (no
// memory, any number of turns).
//
// Node motions in body axes ("triads", same layout as q): dz^ = [R_0^T dx_i; R_0^T R_i dTheta_i; deta]. With
// U_c: rows [I, -y_i~], [0, I], 0;  D = diag(I, D_i, I);  V = D U_c;  Sigma = (A^T V)^-1 A^T:
//     dnu_0 = [R_0^T dx_0; dphi_0] = Sigma D dz^   (dR_0 = R_0 dphi_0~),
//     dq = D (dz^ - U_c dnu_0) = (I - V Sigma) D dz^.
// The same relations hold for velocities. Newton's method at fixed nodes uses dnu_0 = (A^T V)^-1 A^T q, which is exact.
//
// Reference: floating frames, e.g. M. Geradin, A. Cardona, Flexible Multibody Dynamics (Wiley, 2001), ch. 10; here with
// rotations of interfaces as coordinates and solved exactly for finite q.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/interface_rotation.hpp"
#include "mechanism/math/se3.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

using MatrixX6 = Eigen::Matrix<double, Eigen::Dynamic, 6>;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Interfaces count as coincident if they are closer to each other than this fraction of the body's radius of gyration.
inline constexpr double coincident_interfaces = 1e-3;

/// An interface as seen from its body.
struct BodyPoint {
  Vector3 X = Vector3::Zero();          ///< position in the undeformed body [m], body axes
  Matrix3 R_ref = Matrix3::Identity();  ///< node axes -> body axes in the undeformed body
  InterfaceRotation rotation;           ///< rotation of the node relative to the body
  bool keeps_position = true;           ///< all three translations are kept
  int u = 0;                            ///< first row of its displacement in q
  int theta = -1;                       ///< first row of its rotation; -1: its rotations do not act
};

/// The frame and the quantities that its derivatives require, at given nodes. The object is reused from one evaluation
/// to the next.
struct CorotatedGeometry {
  Frame frame;
  VectorX q;               ///< local coordinates
  std::vector<Vector3> y;  ///< [m] position of each point from the frame's origin, body axes
  std::vector<Matrix3> E;  ///< rotation of each point relative to the body
  std::vector<Matrix3> D;  ///< differential of its rotational coordinate
  MatrixX6 V;              ///< D U_c (n,6)
  Matrix6X Sigma;          ///< (A^T V)^-1 A^T (6,n)
};

class CorotatedFrame {
 public:
  CorotatedFrame() = default;
  /// @param points  points whose rows in q do not overlap
  /// @param A       (n,6); the modal amplitudes are the last rows of q
  /// @param size    size of the body [m], used if its interfaces coincide
  CorotatedFrame(std::vector<BodyPoint> points, const MatrixX6& A, double size);

  const std::vector<BodyPoint>& points() const { return points_; }
  const Matrix6X& A_transposed() const { return At_; }

  /// Solves the conditions for the nodes and amplitudes of `state` (node k is point k).
  /// @throws ComputationError if no such frame exists (the nodes are far from any rigid placement of the body)
  void solve(const LocalState& state, CorotatedGeometry& geometry) const;

  /// Returns the rigid placement closest to the nodes in the least-squares sense: the initial guess of the iteration.
  Frame closest_placement(const LocalState& state) const;
  /// Explains for a message why no frame exists: returns the distance of the interfaces from the closest placement.
  std::string misfit(const LocalState& state, CorotatedGeometry& geometry) const;

 private:
  void update(const LocalState& state, CorotatedGeometry& geometry) const;
  /// Returns the last three columns of A^T V; the first three columns are constant.
  Eigen::Matrix<double, 6, 3> turning(const CorotatedGeometry& geometry) const;
  std::vector<BodyPoint> points_;
  Matrix6X At_;                                        ///< A^T
  Eigen::Index rows_ = 0;                              ///< number of columns of A^T up to its last nonzero one
  Matrix3 translation_inverse_ = Matrix3::Identity();  ///< T^-1
  Matrix3 lever_ = Matrix3::Zero();                    ///< M T^-1
  double size_ = 1;                                    ///< [m]: scale of translations and lever of rotations
};

}  // namespace bielle::mechanism
