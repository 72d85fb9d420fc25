// What the input file says of where a motion starts, besides positions and velocities of nodes: values and rates of
// coordinates of components (of joints).
//
// They hold where the first analysis starts, and are no constraints after that. Solvers know a coordinate by its
// component and number alone (Component::start_coordinates, Component::calc_start_coordinate).
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace bielle::mechanism {

class Component;

/// A coordinate of a component by which a start can be described.
struct StartCoordinate {
  std::string name;   ///< "angle"
  std::string units;  ///< "m" or "rad"
  std::string rate_units;
  bool turns = false;  ///< values that differ by whole turns are the same place
};

/// A coordinate at a state.
struct StartCoordinateValue {
  double value = 0;  ///< an angle in (-pi, pi]
  double rate = 0;
};

/// What is asked of a coordinate.
struct StartCondition {
  const Component* component = nullptr;
  std::size_t coordinate = 0;
  std::optional<double> value, rate;
};

}  // namespace bielle::mechanism
