#include "mechanism/model/component.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mechanism/model/measure.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

void Component::add_tangent(const LocalState& /*state*/, LocalTangent& /*tangent*/) const {
  throw std::logic_error("component type '" + type_ + "' gives no derivatives");
}

void Component::add_reaction_norm(const LocalState& /*state*/, double arm, Eigen::Ref<MatrixX> H) const {
  Declaration declaration;
  declare(declaration);
  for (Eigen::Index k = 0; k < H.rows(); ++k)
    H(k, k) += declaration.multipliers[static_cast<std::size_t>(k)].units == "N m" ? 1 / (arm * arm) : 1;
}

double Component::turning_rate(const LocalState& state) const {
  double squared = 0;
  for (std::size_t k = 0; k < state.slots().nodes.size(); ++k)
    squared = std::max(squared, state.node(static_cast<int>(k)).Omega.squaredNorm());
  return std::sqrt(squared);
}

std::unique_ptr<StepRecorder> Component::make_step_recorder() const { return nullptr; }

std::unique_ptr<Measure> Component::make_measure(const std::string& /*name*/, const std::string& measure) const {
  throw std::logic_error("component type '" + type_ + "' has no measure '" + measure + "'");
}

void Component::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX>, Eigen::Ref<VectorX>) const {
  if (state.slots().multipliers > 0)
    throw std::logic_error("component type '" + type_ + "' has constraints but gives no rates of them");
}

}  // namespace bielle::mechanism
