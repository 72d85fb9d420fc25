#include "tests/support/reaction_friction.hpp"

#include <cmath>

namespace bielle::test {

using namespace mechanism;

void ReactionFriction::declare(Declaration& declaration) const {
  declaration.references = {&joint_};
  declaration.reads_reactions = declaration.stiffness = true;
}

void ReactionFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateDerivatives jet;
  joint_.calc_coordinate(0, state.of(0), jet);
  const double F = joint_.calc_reaction(state.of(0)).head<3>().norm();
  r.segment(state.slots().reference_row(0), jet.w().size()) += mu_ * F * std::copysign(1.0, jet.rate) * jet.w();
}

void ReactionFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  CoordinateDerivatives jet;
  MatrixX derivatives;
  joint_.calc_coordinate(0, state.of(0), jet);
  const Vector3 force = joint_.calc_reaction(state.of(0), derivatives).head<3>();
  const double F = force.norm(), friction = mu_ * std::copysign(1.0, jet.rate);
  const int at = state.slots().reference_row(0);
  const auto n = jet.w().size();
  K.block(at, at, n, n) += friction * F * jet.W();
  if (F > 0) K.block(at, at, n, n) += friction * jet.w() * (force.transpose() / F) * derivatives.topRows<3>();
}

}  // namespace bielle::test
