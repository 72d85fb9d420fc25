// Monitors a pulley that a rope grips, between two of its sections: the rope is assumed to stay on it.
//
// With the angle beta by which each section's end is wound on the pulley (alpha + gamma of rope_span.hpp), the rope is
// on the rim along
//     theta = (initial) + sign(rho) (beta_after - beta_before).
// The rope would leave the pulley when theta has decreased to zero: an event is recorded. The pulley still grips it,
// like a cam whose contact is kept when it would lift off.
#pragma once

#include <string>

#include "mechanism/joints/cables/rope_section.hpp"

namespace bielle::mechanism {

class RopeGrip final : public Component {
 public:
  /// @param before,after  sections that end and begin at the pulley
  RopeGrip(const RopeSection& before, const RopeSection& after);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  std::string remark() const override;

 private:
  const RopeSection &before_, &after_;
  double radius_;      ///< signed radius [m]
  double drawn_wrap_;  ///< initial wrap; negative: not touched [rad]
};

}  // namespace bielle::mechanism
