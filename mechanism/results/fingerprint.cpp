// The fingerprint of a model is a short description: counts, start positions, and forces in a test state.
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "mechanism/model/step_recorder.hpp"
#include "mechanism/results/checkpoint.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {
namespace {

/// The format number of a checkpoint grows by one whenever the values exchanged with the Archive, or their order,
/// change.
constexpr int format = 9;

/// Returns the test state. It is near the start and has velocities, so that it shows the dependence of forces on them.
State displaced(const System& system, const State& start) {
  const double length = model_length(start);
  State state = start;
  state.time = 0.01;
  const auto pattern = [](int size, double scale) {
    VectorX v(size);
    for (int i = 0; i < size; ++i) v[i] = scale * std::cos(1 + 2.4 * i);
    return v;
  };
  const int n = system.dofs();
  VectorX dq = pattern(n, 1e-3);
  for (int i = 0; i < n; ++i)
    if (system.kind(i) == Kind::translation) dq[i] *= length;
  system.displace(state, start, dq);
  system.set_rates(state, 100 * dq, 1e4 * dq);
  for (int i = 0; i < system.first_orders(); ++i)
    state.first_order[i] = 1.01 * state.first_order[i] + 0.01 * system.scale(n + i) * std::cos(2 + 2.4 * i);
  state.multiplier.setOnes();
  return state;
}

/// Describes a component's forces in a short text.
std::string forces(const Component& component, const LocalState& state) {
  VectorX r = VectorX::Zero(state.slots().size());
  try {
    component.add_residual(state, r);
  } catch (const ComputationError&) {
    return "refuses";
  }
  std::string text = fmt::format("{:.10g}", r.norm());
  // The events and break points are added, because the forces do not show them.
  Declaration declaration;
  component.declare(declaration);
  if (!declaration.event_functions.empty()) {
    VectorX values(static_cast<Eigen::Index>(declaration.event_functions.size()));
    component.calc_event_functions(state, values);
    for (const double value : values) text += fmt::format(" {:.10g}", value);
  }
  std::vector<double> times;
  component.add_break_points(times);
  for (const double time : times) text += fmt::format(" {:.10g}", time);
  return text;
}

}  // namespace

std::string fingerprint(const Model& model) {
  const System system(model);
  const State start = system.start(0);
  std::string text = fmt::format(
      "checkpoint format {}\nstate nodes {}, dofs {}, first-order unknowns {}, multipliers {}, memory {}\n", format,
      start.nodes.size(), system.dofs(), system.first_orders(), system.multipliers(), start.memory.size());
  const auto numbers = [](const auto& matrix) {
    std::string list;
    for (const double value : matrix.reshaped()) list += fmt::format(" {}", value);
    return list;
  };
  text += fmt::format("gravity{}\n", numbers(model.environment.gravity));
  for (const Node& node : model.nodes())
    text += fmt::format("node '{}'{}{}\n", node.name, numbers(node.frame.x), numbers(node.frame.R));
  const State probe = displaced(system, start);
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const Component& component = *model.members()[m].component;
    text += fmt::format("{} '{}' {}\n", component.type(), component.name(),
                        forces(component, LocalState(probe, system.slots()[m], model.environment)));
  }
  for (const Member& member : model.members())
    if (const auto recorder = member.component->make_step_recorder()) text += recorder->what() + "\n";
  return text;
}

}  // namespace bielle::mechanism
