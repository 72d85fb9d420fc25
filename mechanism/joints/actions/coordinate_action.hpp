// What acts on one coordinate of a joint, whatever the joint's type: drives, springs and dampers, stops, locks.
//
// It refers to the joint: after its own unknowns its local layout holds the joint's, and generalised forces on the
// coordinate are added along the gradients g and w there (coordinate.hpp).
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

  /// Of a multiplier that is a force or torque along the coordinate.
  void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const override;

 protected:
  /// What it refers to: the joint first.
  References& references() { return references_; }
  void declare_references(Declaration& declaration) const;  ///< with a stiffness
  /// The coordinate, without derivatives.
  CoordinateRate value(const LocalState& state) const { return joint_.coordinate(coordinate_, state.of(0)); }
  /// With derivatives: valid until the next call in this thread.
  CoordinateDerivatives& calc(const LocalState& state) const;
  /// First local row of the joint.
  static int row(const LocalState& state) { return state.slots().reference_row(0); }
  /// v^T W of a jet: derivatives of the rate by positions.
  static const VectorX& rate_slope(const LocalState& state, CoordinateDerivatives& jet);
  // A constraint on the coordinate, `distance` = 0, as the component's only row.
  static void add_kept(const LocalState& state, CoordinateDerivatives& jet, double distance, Eigen::Ref<VectorX> r);
  static void add_kept_tangent(const LocalState& state, CoordinateDerivatives& jet, LocalTangent& tangent);
  /// First and second time derivative of the coordinate.
  std::pair<double, double> calc_kept_rates(const LocalState& state) const;

  /// A force on the coordinate as one of the results of the joint, which are the sums of what acts there.
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
