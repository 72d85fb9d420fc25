// Friction along the first coordinate of a joint by its reaction across: -mu |F| sign(v) on the coordinate's rate v, F
// the forces of the joint's multipliers that lock its translations.
#pragma once

#include "mechanism/joints/joint.hpp"

namespace bielle::test {

class ReactionFriction : public mechanism::Component {
 public:
  ReactionFriction(std::string name, const mechanism::Joint& joint, double mu)
      : Component("friction", std::move(name)), joint_(joint), mu_(mu) {}

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  const mechanism::Joint& joint_;
  double mu_;
};

}  // namespace bielle::test
