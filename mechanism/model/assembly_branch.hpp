// Interface of components whose constraint rows also vanish in wrong positions, such as axes that point in opposite
// directions: an assembly then searches for another position.
#pragma once

#include <string>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class AssemblyBranch {
 public:
  virtual ~AssemblyBranch() = default;
  /// Describes in a clause what is wrong with an assembled position although its constraint rows vanish; empty if
  /// nothing is wrong.
  virtual std::string wrong_branch(const LocalState& state) const = 0;
  /// Returns the rotation of the second node relative to the first that would align the directions compared by the
  /// constraints: the smallest rotation vector (inertial components), up to half a turn [rad]. Zero by default: it is
  /// not known.
  virtual Vector3 misalignment(const LocalState& /*state*/) const { return Vector3::Zero(); }
};

}  // namespace bielle::mechanism
