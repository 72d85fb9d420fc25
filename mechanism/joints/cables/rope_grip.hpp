// Monitors a pulley that a rope grips, or on which it slips with friction, between two of its sections: the rope is
// assumed to stay on it.
//
// An event is recorded when the wrap (rope_wrap.hpp) has decreased to zero, at which the rope would leave the pulley.
// The model keeps it on the pulley, as it keeps the contact of a cam that would lift off.
#pragma once

#include <string>

#include "mechanism/joints/cables/rope_wrap.hpp"

namespace bielle::mechanism {

class RopeGrip final : public Component {
 public:
  /// @param before,after  sections that end and begin at the pulley
  /// @param slips         whether the rope slips on the pulley with friction
  RopeGrip(const RopeSection& before, const RopeSection& after, RopeWrap wrap, bool slips);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  std::string remark() const override;

 private:
  const RopeSection &before_, &after_;
  RopeWrap wrap_;
  bool slips_;
};

}  // namespace bielle::mechanism
