// Interface of components whose friction holds in a static analysis only up to a limit, which depends on other forces.
// If there is no equilibrium, the analysis makes them stick and describes the load on them.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class StickingPart {
 public:
  virtual ~StickingPart() = default;
  /// Marks the unknowns that do not change while the part sticks. @param held  State::held (first-order unknowns)
  virtual void hold(const LocalState& state, std::vector<char>& held) const = 0;
  /// Returns a clause on the load at a state in which the part sticks, or empty if its friction could hold this load.
  virtual std::string describe_overload(const LocalState& state) const = 0;

 protected:
  StickingPart() = default;
  StickingPart(const StickingPart&) = default;
  StickingPart& operator=(const StickingPart&) = default;
};

}  // namespace bielle::mechanism
