#include "mechanism/solvers/linearised/mean_forces.hpp"

#include "mechanism/math/so3.hpp"
#include "mechanism/system/node_relation.hpp"

namespace bielle::mechanism {
namespace {

State without_rates(const System& system, const State& state) {
  State still = state;
  const VectorX zero = VectorX::Zero(system.dofs());
  system.set_rates(still, zero, zero);
  return still;
}

}  // namespace

MeanForces::MeanForces(const System& system, const Environment& environment, const TurningPart* part)
    : system_(system), environment_(environment), part_(part) {
  if (part) turning_ = part->turning_unknowns(system);
}

/// Returns the component of gravity normal to the axis. Returns zero if this component is only a rounding error.
Vector3 MeanForces::crosswise(const State& state) const {
  if (!part_) return Vector3::Zero();
  const Vector3 axis = part_->axis(state), g = environment_.gravity, normal = g - axis * axis.dot(g);
  constexpr double rounding = 1e-14;
  return normal.norm() > rounding * g.norm() ? normal : Vector3::Zero();
}

/// Returns the resultant of the residual of the turning nodes.
MeanForces::Load MeanForces::resultant(const VectorX& r, const State& state) const {
  const Vector3 c = part_->through(state);
  Load load;
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const auto node = static_cast<int>(k);
    const NodeFreedom& freedom = system_.kinematics().freedom(node);
    if (!part_->turns(node) || freedom.count == 0 || system_.kinematics().carry(node)) continue;
    const Vector6 force = freedom.G.leftCols(freedom.count) * r.segment(freedom.begin, freedom.count);
    const NodeState& own = state.nodes[k];
    load.force += force.head<3>();
    load.moment += (own.x - c).cross(force.head<3>()) + own.R * force.tail<3>();
  }
  return load;
}

/// Returns the contribution of a field of gravity to the residual.
VectorX MeanForces::forces_of(const Vector3& gravity, const State& still) const {
  Environment with = environment_;
  with.gravity = gravity;
  VectorX r(system_.size()), without(system_.size());
  system_.residual(still, with, r);
  with.gravity.setZero();
  system_.residual(still, with, without);
  return r - without;
}

/// Returns the mean over a turn of the weight of the turning part normal to the axis.
MeanForces::Load MeanForces::mean_weight(const State& state, const State& still) const {
  const Vector3 axis = part_->axis(state), g = crosswise(state), e1 = g.normalized(), e2 = axis.cross(e1);
  const Load along = resultant(forces_of(g, still), state), across = resultant(forces_of(axis.cross(g), still), state);
  Load mean;
  mean.force = e1 * e1.dot(along.force);
  mean.moment = e2 * (0.5 * (e2.dot(along.moment) - e1.dot(across.moment)));
  return mean;
}

void MeanForces::add_to_base(const Load& load, const State& state, Eigen::Ref<VectorX> r) const {
  const NodeKinematics& kinematics = system_.kinematics();
  const Carry* carry = kinematics.carry(part_->base());
  const int node = carry ? carry->carrier : part_->base();
  const NodeFreedom& freedom = kinematics.freedom(node);
  if (freedom.count == 0) return;
  const NodeState& own = state.nodes[static_cast<std::size_t>(node)];
  Vector6 force;
  force << load.force, own.R.transpose() * (load.moment + (part_->through(state) - own.x).cross(load.force));
  r.segment(freedom.begin, freedom.count) += freedom.G.leftCols(freedom.count).transpose() * force;
}

void MeanForces::residual(const State& state, Eigen::Ref<VectorX> r, ResidualScale* scale) const {
  if (!part_) {
    system_.residual(state, environment_, r, scale);
    return;
  }
  const Vector3 g = crosswise(state), axis = part_->axis(state);
  Environment mean = environment_;
  mean.gravity -= g;
  system_.residual(state, mean, r, scale);
  for (int k = 0; k < system_.multipliers(); ++k)
    if (part_->drives_joint(k)) r[system_.size() - system_.multipliers() + k] = 0;
  const State still = without_rates(system_, state);
  VectorX at_rest(system_.size());
  system_.residual(still, mean, at_rest);
  const Load inertia = resultant(r - at_rest, state);
  add_to_base({axis * axis.dot(inertia.force) - inertia.force, axis * axis.dot(inertia.moment) - inertia.moment}, state,
              r);
  if (g.isZero(0)) return;
  const VectorX weight = forces_of(g, still);
  for (std::size_t i = 0; i < turning_.size(); ++i)
    if (turning_[i] == 0) r[static_cast<Eigen::Index>(i)] += weight[static_cast<Eigen::Index>(i)];
  add_to_base(mean_weight(state, still), state, r);
}

SystemMatrices MeanForces::matrices(const State& state, const State* before) const {
  Environment mean = environment_;
  mean.before = before;
  if (!part_) return linearise(system_, mean, state);
  const Vector3 g = crosswise(state);
  mean.gravity -= g;
  SystemMatrices matrices = linearise(system_, mean, state);
  if (g.isZero(0)) return matrices;
  mean.gravity += g;
  SystemMatrices::Sparse change = linearise(system_, mean, state).K - matrices.K;
  change.prune([&](Eigen::Index row, Eigen::Index /*column*/, double /*value*/) {
    return turning_[static_cast<std::size_t>(row)] == 0;
  });
  // The weight acts at a point that is fixed in the standing node of the joint.
  const Load weight = mean_weight(state, without_rates(system_, state));
  const Carry* carry = system_.kinematics().carry(part_->base());
  const int node = carry ? carry->carrier : part_->base();
  const NodeFreedom& freedom = system_.kinematics().freedom(node);
  const NodeState& own = state.nodes[static_cast<std::size_t>(node)];
  const double size = weight.force.squaredNorm();
  const Vector3 at = size > 0 ? Vector3(weight.force.cross(weight.moment) / size) : Vector3::Zero();
  const Matrix3 turned = skew(Vector3(own.R.transpose() * (part_->through(state) + at - own.x))) *
                         skew(Vector3(own.R.transpose() * weight.force));
  const int first = freedom.count - freedom.rotations;
  const MatrixX G = freedom.G.block(3, first, 3, freedom.rotations), block = G.transpose() * turned * G;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < freedom.rotations; ++j)
    for (int i = 0; i < freedom.rotations; ++i)
      entries.emplace_back(freedom.begin + first + i, freedom.begin + first + j, block(i, j));
  SystemMatrices::Sparse of_weight(matrices.K.rows(), matrices.K.cols());
  of_weight.setFromTriplets(entries.begin(), entries.end());
  matrices.K += change + of_weight;
  return matrices;
}

}  // namespace bielle::mechanism
