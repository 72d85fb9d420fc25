#include "mechanism/solvers/linearised/variations.hpp"

#include "mechanism/system/node_relation.hpp"

namespace bielle::mechanism {

NodeVariation node_variation(const System& system, const State& state, const Variation& variation, int node) {
  const NodeKinematics& kinematics = system.kinematics();
  const Carry* carry = kinematics.carry(node);
  const NodeFreedom& freedom = kinematics.freedom(carry ? carry->carrier : node);
  NodeVariation result;
  result.position.setZero();
  result.rate.setZero();
  if (freedom.count == 0) return result;
  const NodeRelation relation = relate(kinematics, node, state, nullptr);
  const Eigen::VectorXcd u = variation.u.segment(freedom.begin, freedom.count),
                         rate = variation.rate.segment(freedom.begin, freedom.count);
  const Eigen::MatrixXcd A = MatrixX(relation.displacement).cast<std::complex<double>>();
  result.position = A * u;
  result.rate = A * rate;
  if (relation.carried) result.rate += MatrixX(relation.rate_of_displacement).cast<std::complex<double>>() * u;
  return result;
}

namespace {

void fill_local(const System& system, const State& state, const Variation& variation, const Slots& slots,
                Eigen::Index begin, LocalVariation& local) {
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const NodeVariation node = node_variation(system, state, variation, slots.nodes[k]);
    local.position.segment<6>(begin + 6 * static_cast<Eigen::Index>(k)) = node.position;
    local.rate.segment<6>(begin + 6 * static_cast<Eigen::Index>(k)) = node.rate;
  }
  const auto take = [&](int row, int from, int count) {
    local.position.segment(begin + row, count) = variation.u.segment(from, count);
    local.rate.segment(begin + row, count) = variation.rate.segment(from, count);
  };
  take(slots.amplitude_row(), system.kinematics().unknowns() + slots.amplitude_begin, slots.amplitudes);
  take(slots.first_order_row(), system.dofs() + slots.first_order_begin, slots.first_orders);
  if (variation.multiplier.size() > 0)
    local.position.segment(begin + slots.multiplier_row(), slots.multipliers) =
        variation.multiplier.segment(slots.multiplier_begin, slots.multipliers);
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    fill_local(system, state, variation, *slots.references[k], begin + slots.reference_row(static_cast<int>(k)), local);
}

}  // namespace

LocalVariation local_variation(const System& system, const State& state, const Variation& variation,
                               const Slots& slots) {
  LocalVariation local{Eigen::VectorXcd::Zero(slots.size()), Eigen::VectorXcd::Zero(slots.size())};
  fill_local(system, state, variation, slots, 0, local);
  return local;
}

}  // namespace bielle::mechanism
