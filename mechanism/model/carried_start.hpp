// A request that a motion begins rigidly: a joint carries all bodies behind it at the start, with the rates of its
// coordinates.
//
// It adds nothing to the equations. Solvers find it among the members of a model, and know the joint as a component
// with start coordinates (model/start_condition.hpp).
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class CarriedStart final : public Component {
 public:
  /// @param joint  a joint of two nodes; it must outlive this object
  explicit CarriedStart(const Component& joint) : Component("carried start", joint.name()), joint_(joint) {}
  const Component& joint() const { return joint_; }
  void declare(Declaration& declaration) const override { declaration.passive = true; }
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}

 private:
  const Component& joint_;
};

}  // namespace bielle::mechanism
