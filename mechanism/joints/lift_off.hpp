// Contacts that only push, held by a constraint that would pull as well.
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Noted where the push, the crossing's value, becomes a pull; the contact stays closed.
inline Crossing lift_off() {
  Crossing crossing{"lifts off", Crossing::Direction::falling};
  crossing.restarts = false;
  crossing.reads_reaction = true;
  return crossing;
}

}  // namespace bielle::mechanism
