#include "mechanism/system/component.hpp"

#include <stdexcept>

#include "mechanism/system/measure.hpp"

namespace bielle::mechanism {

void Component::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  BlockTangent blocks{BlockMatrix(tangent.K), BlockMatrix(tangent.C), BlockMatrix(tangent.M),
                      tangent.wants_K,        tangent.wants_C,        tangent.wants_M};
  add_blocks(state, blocks);
}

void Component::add_blocks(const LocalState& /*state*/, BlockTangent& /*tangent*/) const {
  throw std::logic_error("component type '" + type_ + "' gives no derivatives");
}

void Component::add_reaction_norm(const LocalState& /*state*/, double arm, Eigen::Ref<MatrixX> H) const {
  Declaration declaration;
  declare(declaration);
  for (Eigen::Index k = 0; k < H.rows(); ++k)
    H(k, k) += declaration.multipliers[static_cast<std::size_t>(k)].units == "N m" ? 1 / (arm * arm) : 1;
}

std::unique_ptr<Measure> Component::make_measure(const std::string& /*name*/, const std::string& measure) const {
  throw std::logic_error("component type '" + type_ + "' has no measure '" + measure + "'");
}

void Component::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX>, Eigen::Ref<VectorX>) const {
  if (state.slots().multipliers > 0)
    throw std::logic_error("component type '" + type_ + "' has constraints but gives no rates of them");
}

}  // namespace bielle::mechanism
