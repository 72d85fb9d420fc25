// The current of a DC motor, an unknown of first order. The drive that it belongs to adds its equation.
//
// These are two components, because the voltage may be a formula of the motor's own current, which has no references.
#pragma once

#include <string>
#include <utility>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class MotorCurrent final : public Component {
 public:
  /// @param algebraic  without inductance the equation does not contain the current's rate
  MotorCurrent(std::string name, bool algebraic) : Component("drive", std::move(name)), algebraic_(algebraic) {}
  void declare(Declaration& declaration) const override {
    Declaration::Scalar current{"current", "A"};
    current.scale = 1;
    current.equation_units = algebraic_ ? "A" : "A/s";
    current.algebraic = algebraic_;
    declaration.first_order.push_back(std::move(current));
  }
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}

 private:
  bool algebraic_;
};

/// A multiple of a motor's current: "m.current" [A], "m.torque" [N m].
class MotorCurrentMeasure final : public OwnMeasure {
 public:
  MotorCurrentMeasure(std::string name, const MotorCurrent& current, double factor, std::string units)
      : OwnMeasure(std::move(name), current), factor_(factor), units_(std::move(units)) {}
  std::string units() const override { return units_; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    gradient.position()[own.slots().first_order_row()] = factor_;
    return factor_ * own.first_order()[0];
  }
  double factor_;
  std::string units_;
};

}  // namespace bielle::mechanism
