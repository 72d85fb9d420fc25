// Interface of components with coordinates by which the start of a motion can be described: joints.
//
// Solvers identify a coordinate by its component and index only.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class StartCoordinates {
 public:
  virtual ~StartCoordinates() = default;
  virtual std::vector<StartCoordinate> start_coordinates() const = 0;
  /// Computes one of these coordinates, with gradients of its value by positions and of its rate by velocities over the
  /// local layout.
  /// @param gradient  resized and zeroed by this function
  virtual StartCoordinateValue calc_start_coordinate(std::size_t index, const LocalState& state,
                                                     MeasureGradient& gradient) const = 0;
};

/// Returns the coordinates of a component; none if it is no StartCoordinates.
inline std::vector<StartCoordinate> start_coordinates_of(const Component& component) {
  const auto* coordinates = dynamic_cast<const StartCoordinates*>(&component);
  return coordinates ? coordinates->start_coordinates() : std::vector<StartCoordinate>();
}

}  // namespace bielle::mechanism
