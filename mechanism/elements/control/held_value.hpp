// An output of a sampled block: a measure that keeps its value from one instant to the next (zero-order hold).
//
// The value is this component's memory. The block writes it: it is another component, because its formulas may read the
// outputs of any block, which have no references.
#pragma once

#include <string>
#include <utility>

#include "mechanism/model/description.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

class HeldValue final : public Measure {
 public:
  HeldValue(std::string name, double start, std::string units)
      : Measure(std::move(name)), start_(start), units_(std::move(units)) {}
  std::string units() const override { return units_; }
  void set_units(std::string units) { units_ = std::move(units); }
  double value(const LocalState& state) const override { return state.memory()[0]; }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    return value(state);
  }
  void describe(const LocalState& /*state*/, Description& description) const override {
    description.add(name() + " [" + units_ + "], held between instants");
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.memory = {start_}; }
  double start_;
  std::string units_;
};

}  // namespace bielle::mechanism
