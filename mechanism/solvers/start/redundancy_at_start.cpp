#include "mechanism/solvers/start/redundancy_at_start.hpp"

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"

namespace bielle::mechanism {

std::vector<int> take_out_redundant_at_start(System& system, const Environment& environment, State& state,
                                             State& assembled) {
  assembled = state;
  if (system.switches()) system.begin_branch(assembled, environment);
  const State drawn = assembled;
  try {
    StartReport unused;
    assemble_positions(system, environment, assembled, unused, conditions_of_file(system));
  } catch (const ComputationError&) {
    assembled = drawn;
  }
  std::vector<int> redundant = take_out_redundant(system, environment, assembled);
  state.memory = assembled.memory;
  state.idle = assembled.idle;
  state.multiplier = assembled.multiplier;
  return redundant;
}

}  // namespace bielle::mechanism
