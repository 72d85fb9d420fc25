// Watches a pulley that a rope grips, between two of its sections: the rope is taken to stay on it.
//
// With the angle beta by which each section's end winds on the pulley (alpha + gamma of rope_span.hpp), the rope lies
// on the rim along
//     theta = (as drawn) + sign(rho) (beta_after - beta_before).
// The rope would leave the pulley where theta has fallen to zero: an event is noted. It still grips, as a cam's contact
// still holds where it would lift off.
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
  void calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  std::string remark() const override;

 private:
  const RopeSection &before_, &after_;
  double radius_;      ///< signed [m]
  double drawn_wrap_;  ///< negative: clear of it [rad]
};

}  // namespace bielle::mechanism
