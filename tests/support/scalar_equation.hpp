// One first-order unknown by itself, with any equation.
#pragma once

#include <functional>

#include "mechanism/model/component.hpp"

namespace bielle::test {

class ScalarEquation : public mechanism::Component {
 public:
  /// The residual f(y, dy/dt) with its derivatives by both.
  struct Law {
    double f, by_value, by_rate;
  };
  ScalarEquation(std::string name, mechanism::Declaration::Scalar unknown, std::function<Law(double, double)> law);

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  mechanism::Declaration::Scalar unknown_;
  std::function<Law(double, double)> law_;
};

}  // namespace bielle::test
