// Rigid masses on the body, each of which moves as the mean of a surface or of the nodes around a place: M gets
//     W^T [m I3, 0; 0, J] W,   W u: displacement of the mass's centre and its rotation, body axes (6),
// of rank 6, which is added to products alone: the mesh's M stays m (x) I3. An element dm at xi from the centre moves
// by d + theta x xi. All integrals follow with P = int xi xi^T dm = tr(J)/2 I - J; a mass takes the place of points
// that a rigid tie carries.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/fe/solid.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// A rigid mass and the points that it follows.
struct AddedMass {
  std::string name;
  double mass = 0;                                     ///< [kg]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< its centre [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();   ///< about its centre, body axes [kg m^2]
  SurfaceIntegrals surface;                            ///< the surface or the nodes that it follows
  Eigen::MatrixXd loads;  ///< W^T (3 nodes, 6): forces on the nodes for unit forces x y z and moments on the mass

  /// P = int xi xi^T dm [kg m^2].
  Eigen::Matrix3d second_moment() const;
  /// diag(m, m, m, J).
  Eigen::Matrix<double, 6, 6> matrix() const;
  /// W u. @param u  (3 points, k)
  Eigen::MatrixXd motion(const RowMatrix& u) const;
  /// Adds W^T f to forces on points. @param f  (6, k)
  void add_forces(const Eigen::MatrixXd& f, RowMatrix& forces) const;
};

/// The masses of a body.
class AddedMasses {
 public:
  AddedMasses() = default;
  /// @param body  its name, for messages
  /// @throws InputError about the request: two of the same name, a surface that the mesh does not have, a place outside
  ///         the mesh, a position far from the body, more than a million times the mass or inertia of the body
  AddedMasses(const Solid& solid, const std::vector<MassRequest>& requests, const std::string& body);

  bool empty() const { return masses_.empty(); }
  std::vector<AddedMass>::const_iterator begin() const { return masses_.begin(); }
  std::vector<AddedMass>::const_iterator end() const { return masses_.end(); }

  /// Adds their inertia to M u.
  void add_inertia(const RowMatrix& u, RowMatrix& products) const;
  /// Adds their inertia under accelerations that are linear in space, x from `centre`; columns as LinearFields.
  void add_linear_inertia(const Eigen::Vector3d& centre, RowMatrix& inertia) const;
  /// Adds int T_k^T T_l dm for k l = 11 22 33 23 13 12.
  void add_inertia_components(const RowMatrix& shapes, std::array<Eigen::MatrixXd, 6>& components) const;
  /// W^T sqrt(diag(m, J)) in some rows x y z of points, all masses side by side: its square is their part of M.
  Eigen::MatrixXd root_of_inertia(const std::vector<std::int64_t>& unknowns) const;

 private:
  std::vector<AddedMass> masses_;
};

/// Mass properties of a body and its masses together.
MassProperties with_masses(const MassProperties& body, const AddedMasses& masses);

/// Returns the solid of the request, with its coatings.
/// @throws InputError as make_solid, about `regions`; about a coating whose surface the mesh does not have
Solid requested_solid(const Mesh& mesh, const ReductionOptions& options);

}  // namespace bielle::reduce
