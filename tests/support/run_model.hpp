// Runs a model written as text, for tests that compare states.
#pragma once

#include <functional>
#include <string>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::test {

/// A model with its system, ready to integrate. Redundant constraints are removed.
struct ReadyModel {
  mechanism::MechanismFile file;
  mechanism::System system;
  explicit ReadyModel(const std::string& text)
      : file(mechanism::read_mechanism_text(text, "model.yaml")), system(file.model) {
    system.set_aside(find_redundant(system, file.model.environment, system.start(0)));
  }
  const mechanism::NodeState& node(const mechanism::State& state, const std::string& name) const {
    return state.nodes[static_cast<std::size_t>(*file.model.find_node(name))];
  }
  const mechanism::Environment& environment() const { return file.model.environment; }
};

/// Integrates from 0 to `end` in steps of h. @param record  called at the start and after every step
inline mechanism::State integrate(const ReadyModel& model, const mechanism::Scheme& scheme, double h, double end,
                                  const std::function<void(const mechanism::State&)>& record = {},
                                  mechanism::ConstraintForm form = mechanism::ConstraintForm::corrected) {
  mechanism::TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0), form);
  if (record) record(integration.state());
  integration.start(h);
  const long steps = std::lround(end / h);
  for (long k = 0; k < steps; ++k) {
    integration.step(h);
    if (record) record(integration.state());
  }
  return integration.state();
}

}  // namespace bielle::test
