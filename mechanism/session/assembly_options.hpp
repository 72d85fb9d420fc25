// Options of the assembly of a session.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Nodes and coordinates that keep their values during the assembly.
struct AssemblyOptions {
  /// A coordinate of a component (StartCoordinates).
  struct Coordinate {
    const Component* component = nullptr;
    std::size_t coordinate = 0;
  };
  std::vector<int> kept_nodes;  ///< node indices of the model; all directions are kept
  std::vector<Coordinate> kept_coordinates;
};

/// Adds conditions that keep these nodes and coordinates as they are at a state.
StartConditions with_kept(const System& system, const Environment& environment, const State& state,
                          StartConditions conditions, const AssemblyOptions& options);

}  // namespace bielle::mechanism
