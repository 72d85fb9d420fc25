// Event of unilateral contacts that are modelled by a bilateral constraint.
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Returns an event function whose value is the contact force. The event is recorded when the force changes its sign;
/// the contact stays closed.
inline EventFunction lift_off() {
  EventFunction crossing{"lifts off", EventFunction::Direction::falling};
  crossing.restarts = false;
  crossing.reads_reaction = true;
  return crossing;
}

}  // namespace bielle::mechanism
