// The wish that a motion begins rigidly: a joint carries all that is behind it, by its coordinates' rates at the start.
//
// It adds nothing to the equations. Solvers find it among the members of a model, and know the joint as a component
// with start coordinates (model/start_condition.hpp).
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class CarriedStart final : public Component {
 public:
  /// @param joint  of two nodes; it must outlive this
  explicit CarriedStart(const Component& joint) : Component("carried start", joint.name()), joint_(joint) {}
  const Component& joint() const { return joint_; }
  void declare(Declaration& declaration) const override { declaration.passive = true; }
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}

 private:
  const Component& joint_;
};

}  // namespace bielle::mechanism
