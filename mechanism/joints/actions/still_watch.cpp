#include "mechanism/joints/actions/still_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {

void StillWatch::begin() {
  most_force_ = first_ = farthest_ = 0;
  states_ = 0;
}

void StillWatch::add(const LocalState& state) {
  if (state.environment().statics) return;
  const auto [force, value] = drive_.watched(state);
  if (states_++ == 0) first_ = value;
  most_force_ = std::max(most_force_, std::abs(force));
  farthest_ = std::max(farthest_, std::abs(value - first_));
}

void StillWatch::exchange(Archive& archive) {
  for (double* value : {&most_force_, &first_, &farthest_}) archive(*value);
  archive.within(states_, 0, 1e15);
}

std::string StillWatch::summary() {
  // Any real part deforms by more: steel of 1 m length at a thousandth of its strength deforms by 1e-6 m.
  constexpr double still = 1e-9;  // [m] or [rad]
  if (states_ < 2 || most_force_ == 0 || farthest_ > still) return {};
  return fmt::format(
      "  drive '{}' pushes with up to {:.3g} {}, and the {} of joint '{}' stands still: something else holds it\n",
      drive_.name(), most_force_, drive_.coordinate().force_units(), drive_.coordinate().name, drive_.joint().name());
}

}  // namespace bielle::mechanism
