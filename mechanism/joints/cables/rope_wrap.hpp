// Wrap of a rope on a pulley between two of its sections, on which it is assumed to stay.
//
// With the angle beta by which each section's end is wound on the pulley (alpha + gamma of rope_span.hpp), the rope is
// on the rim along
//     theta = (initial) + sign(rho) (beta_after - beta_before).
#pragma once

#include <string>

#include "mechanism/joints/cables/rope_section.hpp"

namespace bielle::mechanism {

class RopeWrap {
 public:
  /// @param before,after  sections that end and begin at the pulley
  /// @param turns         additional turns as drawn
  RopeWrap(const RopeSection& before, const RopeSection& after, int turns);
  const std::string& pulley() const { return pulley_; }
  double radius() const { return radius_; }  ///< signed radius [m]
  double sense() const { return radius_ < 0 ? -1 : 1; }
  double drawn() const { return drawn_; }  ///< initial wrap; negative: not touched [rad]
  /// Returns the wrap [rad]; negative if the rope would bend backwards.
  double value(const RopeSection::Stretch& before, const RopeSection::Stretch& after) const {
    return drawn_ + sense() * (after.ends[RopeSection::first_end].value - before.ends[RopeSection::last_end].value);
  }

 private:
  std::string pulley_;
  double radius_, drawn_;
};

}  // namespace bielle::mechanism
