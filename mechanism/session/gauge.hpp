// Reads one measure of a model, even if no formula of the model uses it.
#pragma once

#include <memory>
#include <string>

#include "mechanism/model/measure.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class Gauge {
 public:
  /// @param name  as in formulas: "main.angle", "main.angle.rate", "pin.position.x"; or a measure, input or state
  /// @param system  must outlive this object, and so must its model
  /// @throws InputError naming the nearest name
  Gauge(const std::string& name, const System& system);

  double value(const State& state, const Environment& environment) const {
    return measure_->value(LocalState(state, slots_, environment));
  }
  bool reads_reactions() const { return measure_->reads_reactions(); }

 private:
  std::unique_ptr<const Measure> own_;  ///< the measure, if the model has none of this name
  const Measure* measure_;
  Slots slots_;
};

}  // namespace bielle::mechanism
