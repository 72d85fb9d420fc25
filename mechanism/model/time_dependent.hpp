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
  struct Formula {
    std::string name;   ///< among those of the component: "force x"
    std::string units;  ///< of its value: "N"
  };
  /// Those that hold t, in the order of `calc_time_formulas`.
  virtual std::vector<Formula> time_formulas() const = 0;
  /// Their values at a time, with everything else as the state has it.
  /// @param state   of the component
  /// @param time    [s]
  /// @param values  as many as there are formulas
  virtual void calc_time_formulas(const LocalState& state, double time, std::span<double> values) const = 0;
};

}  // namespace bielle::mechanism
