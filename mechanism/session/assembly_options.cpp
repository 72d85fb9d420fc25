#include "mechanism/session/assembly_options.hpp"

namespace bielle::mechanism {

StartConditions with_kept(const System& system, const Environment& environment, const State& state,
                          StartConditions conditions, const AssemblyOptions& options) {
  conditions.kept_nodes = options.kept_nodes;
  for (const auto& [component, coordinate] : options.kept_coordinates)
    keep_coordinate(system, environment, state, *component, coordinate, conditions);
  return conditions;
}

}  // namespace bielle::mechanism
