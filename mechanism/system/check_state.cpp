#include "mechanism/system/check_state.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

[[noreturn]] void refuse_state(const std::string& why) { throw InputError("not a state of this model: " + why); }

void check_node(const std::string& name, const NodeState& node) {
  for (const auto& [what, vector] :
       {std::pair{"position", node.x}, std::pair{"velocity", node.v}, std::pair{"angular velocity", node.Omega},
        std::pair{"acceleration", node.a}, std::pair{"angular acceleration", node.Omegadot}})
    if (!vector.allFinite()) refuse_state(fmt::format("the {} of node '{}' is not finite", what, name));
  constexpr double rounding = 1e-6;  // rounding error of axes in single precision
  const double off = (node.R.transpose() * node.R - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= rounding))
    refuse_state(
        fmt::format("the axes of node '{}' are no rotation: they are not of length one and normal to each "
                    "other, but off by {:.2g}",
                    name, off));
  if (!(node.R.determinant() > 0))
    refuse_state(fmt::format("the axes of node '{}' are no rotation: they are left-handed (a reflection)", name));
}

void check_list(const char* what, const VectorX& list, Eigen::Index size) {
  if (list.size() != size) refuse_state(fmt::format("there are {} {} in place of {}", list.size(), what, size));
  for (Eigen::Index k = 0; k < size; ++k)
    if (!std::isfinite(list[k])) refuse_state(fmt::format("number {} of the {} is not finite", k, what));
}

void check_memory(const System& system, const State& start, const State& state) {
  const Model& model = system.model();
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const Slots& slots = system.slots()[m];
    for (int k = slots.memory_begin; k < slots.memory_begin + slots.memories; ++k)
      if (!std::isfinite(state.memory[k]) && !(std::isnan(state.memory[k]) && std::isnan(start.memory[k])))
        refuse_state(fmt::format("the memory of {} has a number that is not finite", describe(model.members()[m])));
    if (slots.memories > 0 && !model.members()[m].component->knows_memory(LocalState(state, slots, model.environment)))
      refuse_state(fmt::format("the memory of {} has values that are impossible", describe(model.members()[m])));
  }
}

}  // namespace

void check_state(const System& system, const State& state) {
  const State start = system.start(0);
  if (!std::isfinite(state.time) || !std::isfinite(state.motion_factor)) refuse_state("its time is not finite");
  if (state.nodes.size() != start.nodes.size())
    refuse_state(fmt::format("it has {} nodes in place of {}", state.nodes.size(), start.nodes.size()));
  for (std::size_t k = 0; k < state.nodes.size(); ++k) check_node(system.model().nodes()[k].name, state.nodes[k]);
  check_list("amplitudes", state.amplitude, start.amplitude.size());
  check_list("rates of amplitudes", state.amplitude_rate, start.amplitude.size());
  check_list("accelerations of amplitudes", state.amplitude_acceleration, start.amplitude.size());
  check_list("first-order unknowns", state.first_order, start.first_order.size());
  check_list("rates of first-order unknowns", state.first_order_rate, start.first_order.size());
  check_list("multipliers", state.multiplier, start.multiplier.size());
  if (state.reaction.size() > 0) check_list("reactions", state.reaction, start.multiplier.size());
  const auto flags = static_cast<std::size_t>(start.multiplier.size());
  if (!state.idle.empty() && state.idle.size() != flags) refuse_state("it has other constraints");
  if (state.memory.size() != start.memory.size())
    refuse_state(fmt::format("its memory has {} numbers in place of {}", state.memory.size(), start.memory.size()));
  check_memory(system, start, state);
}

}  // namespace bielle::mechanism
