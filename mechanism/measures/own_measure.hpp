// A measure of one component: a function of the variables of that component alone, "brake.flow", "winch.torque".
#pragma once

#include <string>

#include "mechanism/measures/nested.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

class OwnMeasure : public Measure {
 public:
  OwnMeasure(std::string name, const Component& subject) : Measure(std::move(name)), subject_(subject) {}
  double value(const LocalState& state) const final {
    Nested<MeasureGradient> unused;
    return calc_in(state.of(0), *unused);
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const final {
    Nested<MeasureGradient> own;
    const LocalState of_subject = state.of(0);
    const double value = calc_in(of_subject, *own);
    gradient.prepare(state.slots().size());
    const int row = state.slots().reference_row(0), size = of_subject.slots().size();
    gradient.position().segment(row, size) = own->position();
    gradient.rate().segment(row, size) = own->rate();
    return value;
  }

 private:
  double calc_in(const LocalState& own, MeasureGradient& gradient) const {
    gradient.prepare(own.slots().size());
    return calc_own(own, gradient);
  }
  /// @param own       state of the component
  /// @param gradient  derivatives over the component's local layout, zero on entry
  virtual double calc_own(const LocalState& own, MeasureGradient& gradient) const = 0;
  void declare_subjects(Declaration& declaration) const final { declaration.references = {&subject_}; }
  const Component& subject_;
};

}  // namespace bielle::mechanism
