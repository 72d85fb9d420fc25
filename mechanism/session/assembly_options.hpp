// What a session is asked when it assembles.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// What stays as it is while the rest is brought together.
struct AssemblyOptions {
  /// A coordinate of a component (Component::start_coordinates).
  struct Coordinate {
    const Component* component = nullptr;
    std::size_t coordinate = 0;
  };
  std::vector<int> kept_nodes;  ///< of the model, in all directions
  std::vector<Coordinate> kept_coordinates;
};

/// Conditions with what is kept as it is at a state.
StartConditions with_kept(const System& system, const Environment& environment, const State& state,
                          StartConditions conditions, const AssemblyOptions& options);

}  // namespace bielle::mechanism
