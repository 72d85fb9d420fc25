// Rows of holonomic constraints differentiated once: the derivatives of dPhi/dt = B v.
#include <algorithm>

#include "mechanism/system/member_tangent.hpp"

namespace bielle::mechanism {

/// Gets the velocities in the local layout, zero for unknowns that are no positions.
void MemberTangent::get_velocities(Eigen::Ref<VectorX> v) const {
  const State& state = local_.global();
  v.setZero();
  for (const NodePart& part : placement_.nodes) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(part.node)];
    v.segment<3>(part.local) = node.v;
    v.segment<3>(part.local + 3) = node.Omega;
  }
  for (const ScalarPart& part : placement_.scalars)
    if (part.kind == Kind::amplitude)
      v.segment(part.local, part.count) =
          state.amplitude_rate.segment(part.unknown - kinematics_.unknowns(), part.count);
}

void MemberTangent::add_probed_stiffness(const LocalState& probed, Map& sum) {
  sum.setZero();
  const auto target = [&](Map& matrix) { return LocalMatrix(matrix, placement_.blocks_only); };
  LocalTangent tangent{target(sum), target(M_), target(M_), true, false, false};
  component_.add_tangent(probed, tangent);
}

/// K <- d(B v)/dq, C <- B in the rows of holonomic constraints. The matrix d(B^T lambda)/dq of one multiplier at a time
/// contains the same derivatives of B: with H_k = d(B_k)/dq, it is H_k for lambda = e_k, and d(B_k v)/dq = H_k^T v.
void MemberTangent::set_velocity_rows() {
  const int first = slots_.multiplier_row();
  Map unloaded = matrix(work_.columns), loaded = matrix(work_.sum);
  auto v = work_.r.head(n_);
  get_velocities(v);
  const auto for_each_position = [&](const auto& act) {
    const auto columns = [&](int begin, int count) {
      for (int column = begin; column < begin + count; ++column) act(column);
    };
    for (const NodePart& part : placement_.nodes) columns(part.local, 6);
    for (const ScalarPart& part : placement_.scalars)
      if (part.kind == Kind::amplitude) columns(part.local, part.count);
  };
  const std::vector<int>& nonholonomic = placement_.nonholonomic;
  auto lambda = work_.probe.multiplier.segment(slots_.multiplier_begin, slots_.multipliers);
  const LocalState probed(work_.probe, slots_, local_.environment());
  lambda.setZero();
  add_probed_stiffness(probed, unloaded);
  for (int row = first; row < first + slots_.multipliers; ++row) {
    if (std::find(nonholonomic.begin(), nonholonomic.end(), row) != nonholonomic.end()) continue;
    lambda[row - first] = 1;
    add_probed_stiffness(probed, loaded);
    lambda[row - first] = 0;
    for_each_position([&](int column) {
      K_(row, column) = v.dot(loaded.col(column) - unloaded.col(column));
      C_(row, column) = unloaded(row, column);
    });
  }
  lambda = local_.multiplier();
}

}  // namespace bielle::mechanism
