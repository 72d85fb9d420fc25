// Start conditions of the input file in addition to positions and velocities of nodes: values and rates of coordinates
// of components (of joints).
//
// They hold at the start of the first analysis, and are no constraints after that. Solvers identify a coordinate by its
// component and index only (mechanism/model/start_coordinates.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace bielle::mechanism {

class Component;

/// A coordinate of a component by which a start can be described.
struct StartCoordinate {
  std::string name;   ///< name: "angle"
  std::string units;  ///< "m" or "rad"
  std::string rate_units;
  bool turns = false;  ///< values that differ by whole turns are the same position
};

/// Value of a coordinate at a state.
struct StartCoordinateValue {
  double value = 0;  ///< value; an angle is in (-pi, pi]
  double rate = 0;
};

/// The required value or rate of a coordinate.
struct StartCondition {
  const Component* component = nullptr;
  std::size_t coordinate = 0;
  std::optional<double> value, rate;
};

}  // namespace bielle::mechanism
