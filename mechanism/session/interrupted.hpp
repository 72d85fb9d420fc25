// A run that was asked to end from outside.
#pragma once

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

/// Thrown out of a callback between two steps: nothing has failed, and the motion is to be gone on with as if it had
/// not been interrupted.
class Interrupted : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

}  // namespace bielle::mechanism
