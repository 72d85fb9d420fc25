// What the start of a motion has to satisfy besides the constraints, for that start alone: values and rates of
// coordinates, and what is to stay where it is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Of a coordinate of a member (Component::start_coordinates).
struct CoordinateCondition {
  std::size_t member = 0, coordinate = 0;
  std::optional<double> value, rate;
  bool kept = false;  ///< the value is the one that it has: the user keeps it
};

struct StartConditions {
  std::vector<CoordinateCondition> coordinates;
  std::vector<int> kept_nodes;        ///< in all directions
  std::vector<std::size_t> carrying;  ///< members (joints) that carry what is behind them as one rigid body
  bool empty() const { return coordinates.empty() && kept_nodes.empty() && carrying.empty(); }
};

/// Those of the input file.
StartConditions conditions_of_file(const System& system);

/// Keeps a coordinate at the value that it has at a state, unless a start value says where it is to be.
void keep_coordinate(const System& system, const Environment& environment, const State& state,
                     const Component& component, std::size_t coordinate, StartConditions& conditions);

/// A coordinate at a state with its gradients over all dofs, each dof perhaps several times.
struct CoordinateRow {
  using Entries = std::vector<std::pair<int, double>>;
  double value = 0, rate = 0;
  Entries by_position, by_rate;
};
CoordinateRow coordinate_row(const System& system, const Environment& environment, const State& state,
                             std::size_t member, std::size_t coordinate);

/// How far a value is from another: angles by the nearest turn.
double coordinate_distance(const StartCoordinate& coordinate, double value, double from);

StartCoordinate start_coordinate(const System& system, const CoordinateCondition& condition);
/// "angle of joint 'main'"
std::string coordinate_name(const System& system, std::size_t member, const StartCoordinate& coordinate);

}  // namespace bielle::mechanism
