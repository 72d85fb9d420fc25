#include "mechanism/elements/control/state_unknowns.hpp"

#include <utility>

namespace bielle::mechanism {

StateUnknowns::StateUnknowns(std::string type, std::string name, std::vector<std::string> names, VectorX start,
                             std::string units, double scale)
    : Component(std::move(type), std::move(name)),
      names_(std::move(names)),
      start_(std::move(start)),
      units_(std::move(units)),
      scale_(scale) {}

void StateUnknowns::declare(Declaration& declaration) const {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    Declaration::Scalar unknown{names_[k], units_, start_[static_cast<Eigen::Index>(k)]};
    unknown.scale = scale_;
    unknown.equation_units = units_ == "-" ? "1/s" : units_ + "/s";
    unknown.holdable = true;
    declaration.first_order.push_back(std::move(unknown));
  }
  declaration.stiffness = declaration.damping = true;
}

void StateUnknowns::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  for (int k = 0; k < static_cast<int>(size()); ++k)
    if (!state.held(k)) r[k] += state.first_order_rate()[k];
}

void StateUnknowns::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  for (int k = 0; k < static_cast<int>(size()); ++k) {
    if (state.held(k)) {
      if (tangent.wants_K) tangent.K.dense()(k, k) += 1;
    } else if (tangent.wants_C) {
      tangent.C.dense()(k, k) += 1;
    }
  }
}

void StateUnknowns::add_pattern(const Slots& /*slots*/, LocalPattern& pattern) const {
  pattern.add_diagonal(0, 0, static_cast<int>(size()));
}

}  // namespace bielle::mechanism
