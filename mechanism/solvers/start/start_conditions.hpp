// Conditions of the start of a motion in addition to the constraints: values and rates of coordinates, and nodes and
// coordinates that are kept.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// A condition for a coordinate of a member (StartCoordinates).
struct CoordinateCondition {
  std::size_t member = 0, coordinate = 0;
  std::optional<double> value, rate;
  bool kept = false;  ///< the user keeps the present value
};

struct StartConditions {
  std::vector<CoordinateCondition> coordinates;
  std::vector<int> kept_nodes;        ///< kept in all directions
  std::vector<std::size_t> carrying;  ///< members (joints) that carry the parts behind them as rigid bodies
  bool empty() const { return coordinates.empty() && kept_nodes.empty() && carrying.empty(); }
};

/// Returns the conditions of the input file.
StartConditions conditions_of_file(const System& system);

/// Keeps a coordinate at its value in a state, unless a start value is given.
void keep_coordinate(const System& system, const Environment& environment, const State& state,
                     const Component& component, std::size_t coordinate, StartConditions& conditions);

/// A coordinate at a state with its gradients over all dofs, in which a dof may occur several times.
struct CoordinateRow {
  using Entries = std::vector<std::pair<int, double>>;
  double value = 0, rate = 0;
  Entries by_position, by_rate;
};
CoordinateRow coordinate_row(const System& system, const Environment& environment, const State& state,
                             std::size_t member, std::size_t coordinate);

/// Returns the difference of two values: for angles, that of the nearest turn.
double coordinate_distance(const StartCoordinate& coordinate, double value, double from);

StartCoordinate start_coordinate(const System& system, const CoordinateCondition& condition);
/// Returns "angle of joint 'main'".
std::string coordinate_name(const System& system, std::size_t member, const StartCoordinate& coordinate);

}  // namespace bielle::mechanism
