// A run that was asked to end from outside.
#pragma once

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

/// It is thrown from a callback between two steps: no error has occurred, and the motion can be continued as if it had
/// not been interrupted.
class Interrupted : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

}  // namespace bielle::mechanism
