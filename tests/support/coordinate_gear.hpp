// A gear between coordinates of two joints: the smallest component with a constraint on the unknowns of others.
//
//   c_1 + ratio c_2 = 0,   of the coordinates c_1, c_2 (displacements or angles)
//
// It may be made before its joints, so that it precedes them in a model.
#pragma once

#include "mechanism/joints/joint.hpp"

namespace bielle::test {

class CoordinateGear : public mechanism::Component {
 public:
  CoordinateGear(std::string name, double ratio) : Component("gear", std::move(name)), factors_{1, ratio} {}
  /// The first coordinate of each joint. Call before the model is numbered.
  void join(const mechanism::Joint& first, const mechanism::Joint& second) { joints_ = {&first, &second}; }

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;
  void add_constraint_rates(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> velocity,
                            Eigen::Ref<mechanism::VectorX> acceleration) const override;

 private:
  std::array<double, 2> factors_;
  std::array<const mechanism::Joint*, 2> joints_{};
};

}  // namespace bielle::test
