// What a session is asked when it assembles.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/model/model.hpp"

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

}  // namespace bielle::mechanism
