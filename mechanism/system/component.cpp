#include "mechanism/system/component.hpp"

#include <stdexcept>

namespace bielle::mechanism {

void Component::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX>, Eigen::Ref<VectorX>) const {
  if (state.slots().multipliers > 0)
    throw std::logic_error("component type '" + type_ + "' has constraints but gives no rates of them");
}

}  // namespace bielle::mechanism
