// Interface of components whose formulas depend explicitly on time: solvers evaluate them between the ends of a step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class TimeDependent {
 public:
  virtual ~TimeDependent() = default;
  /// The role of a formula in the equations.
  enum class Part {
    force,     ///< part of a residual: forces, flows, rates of states, given pressures
    position,  ///< it prescribes a position [m] or [rad]
    rate       ///< it prescribes the rate of a position
  };
  struct Formula {
    std::string name;   ///< name among the component's formulas: "force x"
    std::string units;  ///< units of its value: "N"; empty if unknown
    Part part = Part::force;
    bool turns = false;  ///< whether it is a position in rad, or the rate of one
  };
  /// Returns the formulas that contain t, directly or through measures, in the order of `calc_time_formulas`.
  virtual std::vector<Formula> time_formulas() const = 0;
  /// Values of these formulas at the state's time; zero if they have no effect any more.
  /// @param state   state of the component
  /// @param values  one value for each formula
  virtual void calc_time_formulas(const LocalState& state, std::span<double> values) const = 0;
};

/// Interface of measures whose formulas may contain the time: formulas that read such a measure then depend on time,
/// too.
class TimedMeasure {
 public:
  virtual ~TimedMeasure() = default;
  virtual bool holds_time() const = 0;
};

}  // namespace bielle::mechanism
