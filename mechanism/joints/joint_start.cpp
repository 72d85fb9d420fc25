// Coordinates of a joint that the start of a motion may prescribe, keep and report.
#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

std::vector<StartCoordinate> Joint::start_coordinates() const {
  std::vector<StartCoordinate> result;
  for (const JointCoordinate& each : coordinates_)
    result.push_back({each.name, each.units(), each.rate_units(), each.kind == JointCoordinate::Kind::angle});
  return result;
}

StartCoordinateValue Joint::calc_start_coordinate(std::size_t index, const LocalState& state,
                                                  MeasureGradient& gradient) const {
  thread_local CoordinateSlopes slopes;
  calc_slopes(index, state, slopes);
  gradient.prepare(state.slots().size());
  gradient.position() = slopes.g();
  gradient.rate() = slopes.w();
  return {slopes.principal, slopes.rate};
}

std::string Joint::remark() const {
  if (frames_.arm == 0) return {};
  return fmt::format(
      "without `position` or `at` it is attached at node '{}'; an arm of {:.3g} m bridges it to node '{}'",
      second_name_, frames_.arm, first_name_);
}

}  // namespace bielle::mechanism
