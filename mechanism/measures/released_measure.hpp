// A force measured on an entry that may be released: it is zero while the entry is.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mechanism/model/activity.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

class ReleasedMeasure final : public Measure {
 public:
  /// @param measure     force as if the entry were active
  /// @param activities  those that govern the component measured
  ReleasedMeasure(std::unique_ptr<Measure> measure, std::vector<const Activity*> activities)
      : Measure(measure->name()), measure_(std::move(measure)), activities_(std::move(activities)) {}
  std::string units() const override { return measure_->units(); }
  double value(const LocalState& state) const override { return is_active(state) ? measure_->value(state) : 0; }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    if (is_active(state)) return measure_->calc(state, gradient);
    gradient.prepare(state.slots().size());
    return 0;
  }
  bool reads_reactions() const override { return measure_->reads_reactions(); }

 private:
  /// The activities follow the references of the measure itself, whose numbers stay the same.
  void declare_subjects(Declaration& declaration) const override {
    measure_->declare(declaration);
    declaration.references.insert(declaration.references.end(), activities_.begin(), activities_.end());
  }
  bool is_active(const LocalState& state) const {
    const auto first = static_cast<int>(state.slots().references.size() - activities_.size());
    for (int k = 0; k < static_cast<int>(activities_.size()); ++k)
      if (!Activity::is_active(state.of(first + k))) return false;
    return true;
  }

  std::unique_ptr<Measure> measure_;
  std::vector<const Activity*> activities_;
};

}  // namespace bielle::mechanism
