// Actions on one coordinate of a joint, independent of the joint's type: drives, springs and dampers, stops, locks.
//
// An action refers to the joint: its local layout contains its own unknowns, then the joint's, and generalised forces
// on the coordinate are added along the gradients g and w there (coordinate.hpp).
#pragma once

#include <utility>

#include "mechanism/joints/joint.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

class CoordinateAction : public Component {
 public:
  CoordinateAction(std::string type, std::string name, const Joint& joint, std::size_t coordinate);
  const Joint& joint() const { return joint_; }
  const JointCoordinate& coordinate() const { return joint_.coordinates()[coordinate_]; }

  /// Adds the norm of a multiplier that is a force or torque along the coordinate.
  void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const override;

 protected:
  /// Returns the references of the action, of which the joint is the first.
  References& references() { return references_; }
  void declare_references(Declaration& declaration) const;  ///< and a stiffness
  /// Returns the coordinate, without derivatives.
  CoordinateRate value(const LocalState& state) const { return joint_.coordinate(coordinate_, state.of(0)); }
  /// Returns the coordinate with derivatives: valid until the next call in this thread.
  CoordinateDerivatives& calc(const LocalState& state) const;
  /// Returns the coordinate with its gradients: valid until the next call in this thread.
  CoordinateSlopes& calc_slopes(const LocalState& state) const;
  /// Returns the first local row of the joint.
  static int row(const LocalState& state) { return state.slots().reference_row(0); }
  /// Returns v^T W of a jet, the derivatives of the rate by positions.
  static const VectorX& rate_slope(const LocalState& state, CoordinateDerivatives& jet);
  // Adds a constraint on the coordinate, `distance` = 0, as the component's only row.
  static void add_kept(const LocalState& state, CoordinateSlopes& slopes, double distance, Eigen::Ref<VectorX> r);
  static void add_kept_tangent(const LocalState& state, CoordinateDerivatives& jet, LocalTangent& tangent);
  /// Computes first and second time derivative of the coordinate.
  std::pair<double, double> calc_kept_rates(const LocalState& state) const;

  /// Returns the output field of a force on the coordinate among the results of the joint, which are sums over the
  /// actions.
  OutputField force_field(const std::string& name, const std::string& description) const {
    return joint_.force_field(name, description);
  }
  void write_force(double force, double* values) const;

 private:
  const Joint& joint_;
  std::size_t coordinate_;
  References references_;
};

}  // namespace bielle::mechanism
