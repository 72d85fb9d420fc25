// Components whose formulas hold the time: solvers look at them between the ends of a step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class TimeDependent {
 public:
  virtual ~TimeDependent() = default;
  /// The part that a formula has in the equations.
  enum class Part {
    force,     ///< in a residual: forces, flows, rates of states, given pressures
    position,  ///< it prescribes a position [m] or [rad]
    rate       ///< it prescribes the rate of one
  };
  struct Formula {
    std::string name;   ///< among those of the component: "force x"
    std::string units;  ///< of its value: "N"; empty where they are unknown
    Part part = Part::force;
    bool turns = false;  ///< a position in rad, or the rate of one
  };
  /// Those that hold t, by themselves or by measures, in the order of `calc_time_formulas`.
  virtual std::vector<Formula> time_formulas() const = 0;
  /// Their values at the state's time; zero where they have no effect any more.
  /// @param state   of the component
  /// @param values  as many as there are formulas
  virtual void calc_time_formulas(const LocalState& state, std::span<double> values) const = 0;
};

/// Measures whose formulas may hold the time: formulas that read them hold it, too.
class TimedMeasure {
 public:
  virtual ~TimedMeasure() = default;
  virtual bool holds_time() const = 0;
};

}  // namespace bielle::mechanism
