// Forces on all components to which a component refers, which depend on all of their unknowns: positions, axes,
// amplitudes, first-order unknowns, multipliers, rates and accelerations, also of further references.
//
//   r = w s(p),   s = sin(p) + p^2/4,   p = sum of each unknown's or rate's share
//
// w is a constant vector, zero in rows of constraints; for node axes R, the share is b . R c of constant b, c.
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::test {

class StateMixer : public mechanism::Component {
 public:
  StateMixer(std::string name, std::vector<int> nodes, std::vector<const mechanism::Component*> references)
      : Component("mixer", std::move(name)), nodes_(std::move(nodes)), references_(std::move(references)) {}
  /// Call before the model is numbered.
  void refer_to(const mechanism::Component& component) { references_.push_back(&component); }

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  std::vector<int> nodes_;
  std::vector<const mechanism::Component*> references_;
};

}  // namespace bielle::test
