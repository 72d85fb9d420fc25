#include "mechanism/joints/friction/creeping_friction.hpp"

namespace bielle::mechanism {

JointFriction::Resistance CreepingFriction::resistance(const LocalState& /*state*/, const Vector& v) const {
  const auto [h, slope] = law().sliding(v.norm());
  Resistance result{h * v, slope * v * v.transpose(), {}};
  result.by_v.diagonal().array() += h;
  return result;
}

}  // namespace bielle::mechanism
