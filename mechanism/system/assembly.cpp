// Residual and tangent of the whole from those of the components.
//
// Residual: local forces are added node by node, carried nodes hand theirs to their carriers, and G^T keeps the free
// directions. Tangent: with z = (x, R) of a local node, da = W_z dz + W_v dv + A..., see node_kinematics.hpp,
//     dr = (K A + C V + M W_z) G T dp + (C A + M W_v) G dv + M A G da,     rows (A G)^T,
// plus the turning of the arm at fixed force, c~ (R^T f)~ on the carrier's rotations.
#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {
namespace {

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;

/// The relations of one local node to its independent increments.
struct NodeRelation {
  Matrix6X displacement;                  ///< A G
  Matrix6X displacement_step;             ///< A G T: along increments since the base
  Matrix6X rate_of_displacement;          ///< V G T
  Matrix6X acceleration_of_displacement;  ///< W_z G T
  Matrix6X acceleration_of_rate;          ///< W_v G
  bool carried = false;
};

/// X T(Dq) on the columns of three free rotations; about a single axis T is the identity.
Matrix6X times_step_tangent(const Matrix6X& X, const NodeFreedom& f, const VectorX* dq) {
  Matrix6X Y = X;
  if (dq && f.rotations == 3) Y.rightCols<3>() = X.rightCols<3>() * tangent(dq->segment<3>(f.begin + f.count - 3));
  return Y;
}

NodeRelation relate(const NodeKinematics& kinematics, int node, const State& state, const VectorX* dq) {
  NodeRelation relation;
  const Carry* carry = kinematics.carry(node);
  const NodeFreedom& f = kinematics.freedom(carry ? carry->carrier : node);
  const Matrix6X G = f.G.leftCols(f.count);
  const Matrix6X GT = times_step_tangent(G, f, dq);
  if (!carry) {
    relation.displacement = G;
    relation.displacement_step = GT;
    return relation;
  }
  relation.carried = true;
  const NodeState& i = state.nodes[static_cast<std::size_t>(carry->carrier)];
  const Vector3 arm_rate = i.Omega.cross(carry->c);
  Matrix6 A = Matrix6::Zero(), V = Matrix6::Zero(), W_z = Matrix6::Zero(), W_v = Matrix6::Zero();
  A.topLeftCorner<3, 3>().setIdentity();
  A.topRightCorner<3, 3>() = -i.R * skew(carry->c);
  A.bottomRightCorner<3, 3>() = carry->R_c.transpose();
  V.topRightCorner<3, 3>() = -i.R * skew(arm_rate);
  W_v.topRightCorner<3, 3>() = -i.R * (skew(arm_rate) + skew(i.Omega) * skew(carry->c));
  W_z.topRightCorner<3, 3>() = -i.R * skew(i.Omegadot.cross(carry->c) + i.Omega.cross(arm_rate));
  relation.displacement = A * G;
  relation.displacement_step = A * GT;
  relation.rate_of_displacement = V * GT;
  relation.acceleration_of_displacement = W_z * GT;
  relation.acceleration_of_rate = W_v * G;
  return relation;
}

/// Three columns of A from `first` on, times T.
void multiply_columns(Eigen::Map<MatrixX>& A, Eigen::Index first, const Matrix3& T) {
  double *__restrict x = A.col(first).data(), *__restrict y = A.col(first + 1).data(),
         *__restrict z = A.col(first + 2).data();
  for (Eigen::Index row = 0; row < A.rows(); ++row) {
    const double a = x[row], b = y[row], c = z[row];
    x[row] = a * T(0, 0) + b * T(1, 0) + c * T(2, 0);
    y[row] = a * T(0, 1) + b * T(1, 1) + c * T(2, 1);
    z[row] = a * T(0, 2) + b * T(1, 2) + c * T(2, 2);
  }
}

}  // namespace

void System::node_forces(const State& state, const Environment& environment, VectorX& forces, Eigen::Ref<VectorX> r,
                         ResidualScale* scale) const {
  // Zero but while a component's part is in it. (Components do not evaluate systems.)
  thread_local VectorX buffer;
  if (buffer.size() < largest_local_) buffer.setZero(largest_local_);
  forces.setZero(kinematics_.force_rows());
  double *const local = buffer.data(), *const force_values = forces.data(), *const scalar_values = r.data();
  const int* force_row = force_rows_.data();
  const int amplitude_row = kinematics_.unknowns(), first_order_row = dofs(), multiplier_row = dofs() + first_orders_;
  // Of any component, by direction.
  Vector3 largest_force = Vector3::Zero(), largest_moment = Vector3::Zero();
  ResidualScale of_references;
  for (const std::size_t m : acting_) {
    const Slots& slots = slots_[m];
    try {
      model_.members()[m].component->add_residual(LocalState(state, slots, environment),
                                                  Eigen::Map<VectorX>(local, slots.size()));
    } catch (...) {
      buffer.setZero();
      throw;
    }
    double* part = local;
    for (const int* const end = force_row + slots.nodes.size(); force_row != end; ++force_row, part += 6) {
      // In threes, as components write them: a read that spans two writes has to wait for both.
      const Vector3 force = Eigen::Map<const Vector3>(part), moment = Eigen::Map<const Vector3>(part + 3);
      std::fill_n(part, 6, 0.0);
      Eigen::Map<Vector3>(force_values + *force_row) += force;
      Eigen::Map<Vector3>(force_values + *force_row + 3) += moment;
      largest_force = largest_force.cwiseMax(force.cwiseAbs());
      largest_moment = largest_moment.cwiseMax(moment.cwiseAbs());
    }
    const auto scalars = [&](int count, int row) {
      for (int k = 0; k < count; ++k) scalar_values[row + k] += std::exchange(part[k], 0);
      part += count;
    };
    scalars(slots.amplitudes, amplitude_row + slots.amplitude_begin);
    scalars(slots.first_orders, first_order_row + slots.first_order_begin);
    scalars(slots.multipliers, multiplier_row + slots.multiplier_begin);
    if (slots.referenced > 0) {
      add_referenced(placements_[m], local, forces, r, of_references);
      std::fill_n(part, slots.referenced, 0.0);
    }
  }
  if (scale) {
    (*scale)[Kind::translation] = std::max(largest_force.maxCoeff(), of_references[Kind::translation]);
    (*scale)[Kind::rotation] = std::max(largest_moment.maxCoeff(), of_references[Kind::rotation]);
    // What is one component's in the other rows; others may have added to them.
    const auto largest = [&](Kind kind, int begin, int count) {
      (*scale)[kind] = count > 0 ? r.segment(begin, count).lpNorm<Eigen::Infinity>() : 0.0;
      (*scale)[kind] = std::max((*scale)[kind], of_references[kind]);
    };
    largest(Kind::amplitude, amplitude_row, amplitudes_);
    largest(Kind::first_order, first_order_row, first_orders_);
    largest(Kind::multiplier, multiplier_row, multipliers_);
  }
  kinematics_.carry_forces(state.nodes, forces);
}

/// What a component adds to equations of those that it refers to. @param part  its local vector
void System::add_referenced(const Placement& placement, double* part, VectorX& forces, Eigen::Ref<VectorX> r,
                            ResidualScale& scale) const {
  for (std::size_t k = 0; k < placement.nodes.size(); ++k) {
    const NodePart& node = placement.nodes[k];
    if (node.local < placement.own_size) continue;
    Eigen::Map<const Vector6> local(part + node.local);
    forces.segment<6>(kinematics_.force_row(node.node)) += local;
    scale[Kind::translation] = std::max(scale[Kind::translation], local.head<3>().lpNorm<Eigen::Infinity>());
    scale[Kind::rotation] = std::max(scale[Kind::rotation], local.tail<3>().lpNorm<Eigen::Infinity>());
  }
  for (const ScalarPart& scalars : placement.scalars) {
    if (scalars.own || scalars.kind == Kind::multiplier) continue;
    Eigen::Map<const VectorX> local(part + scalars.local, scalars.count);
    r.segment(scalars.unknown, scalars.count) += local;
    scale[scalars.kind] = std::max(scale[scalars.kind], local.lpNorm<Eigen::Infinity>());
  }
}

void System::residual(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                      ResidualScale* scale) const {
  thread_local VectorX forces;
  r.setZero();
  if (scale) *scale = {};
  node_forces(state, environment, forces, r, scale);
  kinematics_.reduce_forces(forces, r.head(kinematics_.unknowns()));
  for_each_idle(state, [&](int multiplier) { r[dofs() + first_orders_ + multiplier] = state.multiplier[multiplier]; });
}

Energy System::energy(const State& state, const Environment& environment) const {
  Energy energy;
  for (std::size_t m = 0; m < slots_.size(); ++m)
    model_.members()[m].component->add_energy(LocalState(state, slots_[m], environment), energy);
  if (kinematics_.any_prescribed()) {
    VectorX forces, scalars = VectorX::Zero(size());
    node_forces(state, environment, forces, scalars, nullptr);
    energy.input += kinematics_.support_power(state.nodes, forces);
  }
  return energy;
}

/// Buffers of one thread, so that no component's turn touches the heap: local matrices, their reduced sum; T(Dq) of
/// each node that is free in all directions; relations of a component's nodes; a state whose multipliers are tried out.
struct System::Workspace {
  std::vector<double> K, C, M, columns, sum;
  VectorX r;
  std::vector<Matrix3> step_tangent;
  std::vector<NodeRelation> relation;
  State probe;
  explicit Workspace(int n) {
    const auto size = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    for (auto* buffer : {&K, &C, &M, &columns, &sum}) buffer->resize(size);
    r.resize(n);
  }
};

/// Adds local entries to the global values.
void System::scatter(const Targets& targets, const double* entries, std::vector<double>& values) {
  for (const auto [first, place] : targets.triples) {
    const double* entry = entries + first;
    double* value = values.data() + place;
    value[0] += entry[0];
    value[1] += entry[1];
    value[2] += entry[2];
  }
  for (const auto [entry, place] : targets.singles) values[static_cast<std::size_t>(place)] += entries[entry];
}

/// K <- d(B v)/dq, C <- B in the rows of holonomic constraints. d(B^T lambda)/dq of one multiplier at a time has the
/// same derivatives of B in it: with H_k = d(B_k)/dq, it is H_k for lambda = e_k, and d(B_k v)/dq = H_k^T v.
void System::velocity_rows(const Placement& placement, const LocalState& local, const Component& component,
                           Workspace& work) const {
  const Slots& slots = local.slots();
  const int n = slots.size(), first = slots.multiplier_row();
  using Map = Eigen::Map<MatrixX>;
  Map K(work.K.data(), n, n), C(work.C.data(), n, n), unused(work.M.data(), n, n), unloaded(work.columns.data(), n, n),
      loaded(work.sum.data(), n, n);
  // Velocities, zero where an unknown is none of positions.
  auto v = work.r.head(n);
  v.setZero();
  const State& state = local.global();
  for (const NodePart& part : placement.nodes) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(part.node)];
    v.segment<3>(part.local) = node.v;
    v.segment<3>(part.local + 3) = node.Omega;
  }
  for (const ScalarPart& part : placement.scalars)
    if (part.kind == Kind::amplitude)
      v.segment(part.local, part.count) =
          state.amplitude_rate.segment(part.unknown - kinematics_.unknowns(), part.count);
  auto lambda = work.probe.multiplier.segment(slots.multiplier_begin, slots.multipliers);
  const LocalState probed(work.probe, slots, local.environment());
  const auto add_stiffness = [&](Map& sum) {
    sum.setZero();
    LocalTangent tangent{sum, unused, unused, true, false, false};
    component.add_tangent(probed, tangent);
  };
  const auto for_each_position = [&](const auto& act) {
    const auto columns = [&](int begin, int count) {
      for (int column = begin; column < begin + count; ++column) act(column);
    };
    for (const NodePart& part : placement.nodes) columns(part.local, 6);
    for (const ScalarPart& part : placement.scalars)
      if (part.kind == Kind::amplitude) columns(part.local, part.count);
  };
  lambda.setZero();
  add_stiffness(unloaded);
  for (int row = first; row < first + slots.multipliers; ++row) {
    if (std::find(placement.nonholonomic.begin(), placement.nonholonomic.end(), row) != placement.nonholonomic.end())
      continue;
    lambda[row - first] = 1;
    add_stiffness(loaded);
    lambda[row - first] = 0;
    for_each_position([&](int column) {
      K(row, column) = v.dot(loaded.col(column) - unloaded.col(column));
      C(row, column) = unloaded(row, column);
    });
  }
  lambda = local.multiplier();
}

/// K, weighted: own rows and columns of constraints, derivatives by the multipliers of others, and the rest.
void System::weigh_stiffness(const Placement& placement, const Slots& slots, const TangentWeights& weights,
                             Eigen::Map<MatrixX>& K) const {
  const int own = slots.multiplier_row(), multipliers = slots.multipliers, n = slots.size();
  if (slots.referenced == 0) {
    if (weights.stiffness != 1) K.topLeftCorner(own, own) *= weights.stiffness;
    if (weights.constraint != 1) {
      K.bottomRows(multipliers) *= weights.constraint;
      K.topRightCorner(own, multipliers) *= weights.constraint;
    }
    return;
  }
  const double reaction = weights.reactions ? 1 : weights.stiffness;
  const auto weigh_columns = [&](int begin, int count, double weight) {
    auto columns = K.middleCols(begin, count);
    columns.topRows(own) *= weight;
    columns.middleRows(own, multipliers) *= weights.constraint;
    columns.bottomRows(n - own - multipliers) *= weight;
  };
  weigh_columns(0, own, weights.stiffness);
  weigh_columns(own, multipliers, weights.constraint);
  for (const NodePart& part : placement.nodes)
    if (part.local >= placement.own_size) weigh_columns(part.local, 6, weights.stiffness);
  for (const ScalarPart& part : placement.scalars)
    if (!part.own)
      weigh_columns(part.local, part.count, part.kind == Kind::multiplier ? reaction : weights.stiffness);
}

void System::add_in_place(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                          const Component& component, const Matrix3* turns, std::vector<double>& values) const {
  const auto into = [&](double weight, double constraint, const Matrix3* turned) {
    return BlockMatrix(placement.places, values.data(), weight, constraint, turned);
  };
  BlockTangent tangent{
      into(weights.stiffness, weights.constraint, turns),
      into(weights.damping, weights.damping, nullptr),
      into(weights.mass, weights.mass, nullptr),
      placement.stiffness && (weights.stiffness != 0 || (weights.constraint != 0 && local.slots().multipliers > 0)),
      placement.damping && weights.damping != 0,
      placement.mass && weights.mass != 0};
  if (tangent.wants_K || tangent.wants_C || tangent.wants_M) component.add_blocks(local, tangent);
}

void System::add_reduced(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                         const Component& component, const VectorX* dq, Workspace& work,
                         std::vector<double>& values) const {
  const Slots& slots = local.slots();
  const int n = slots.size();
  using Map = Eigen::Map<MatrixX>;
  Map K(work.K.data(), n, n), C(work.C.data(), n, n), M(work.M.data(), n, n);
  // Convective terms of carried nodes bring C and M into the stiffness: then all three are needed.
  const bool wants_K = placement.stiffness &&
                       (weights.stiffness != 0 || (weights.constraint != 0 && slots.multipliers > 0) ||
                        (weights.reactions && placement.reads_multipliers));
  const bool rates_in_K = !placement.plain && weights.stiffness != 0;
  const bool rate_rows = weights.acceleration_level && !placement.nonholonomic.empty();
  const bool wants_C =
      placement.damping && (rates_in_K || weights.damping != 0 || weights.first_order != 0 || rate_rows);
  const bool wants_M = placement.mass && (rates_in_K || weights.mass != 0 || weights.damping != 0);
  if (weights.velocity_level ? slots.multipliers == 0 : !wants_K && !wants_C && !wants_M && placement.plain) return;
  const auto clear = [&](std::vector<double>& matrix) { std::fill_n(matrix.begin(), n * n, 0.0); };
  clear(work.K);
  if (wants_C || weights.velocity_level || !placement.plain) clear(work.C);
  if (wants_M || !placement.plain) clear(work.M);
  if (weights.velocity_level) {
    velocity_rows(placement, local, component, work);
  } else {
    LocalTangent tangent{K, C, M, wants_K, wants_C, wants_M};
    component.add_tangent(local, tangent);
  }
  if (rate_rows)
    for (const int row : placement.nonholonomic) {
      K.row(row) = C.row(row);
      C.row(row).setZero();
    }
  if (wants_K) weigh_stiffness(placement, slots, weights, K);
  if (placement.plain) {
    add_plain(placement, weights, dq, wants_K, wants_C || weights.velocity_level, wants_M && !weights.velocity_level,
              n, work);
    scatter(placement.targets, K.data(), values);
  } else {
    add_related(placement, local, weights, component, dq, work);
    scatter(placement.targets, work.sum.data(), values);
  }
}

/// K <- K T(Dq) + damping C + mass M, columns of first-order unknowns with their own weight of C.
void System::add_plain(const Placement& placement, const TangentWeights& weights, const VectorX* dq, bool with_K,
                       bool with_C, bool with_M, int n, Workspace& work) const {
  using Map = Eigen::Map<MatrixX>;
  Map K(work.K.data(), n, n), C(work.C.data(), n, n), M(work.M.data(), n, n);
  if (dq && with_K)
    for (const NodePart& part : placement.nodes)
      if (kinematics_.freedom(part.node).all_free)
        multiply_columns(K, part.local + 3, work.step_tangent[static_cast<std::size_t>(part.node)]);
  if (with_C) {
    // Own nodes stand together: most components have no others.
    const int own_rows = placement.own_nodes_end;
    K.leftCols(own_rows) += weights.damping * C.leftCols(own_rows);
    for (const NodePart& part : placement.nodes)
      if (part.local >= placement.own_size)
        K.middleCols<6>(part.local) += weights.damping * C.middleCols<6>(part.local);
    for (const ScalarPart& part : placement.scalars)
      if (part.kind != Kind::multiplier)
        K.middleCols(part.local, part.count) +=
            (part.kind == Kind::amplitude ? weights.damping : weights.first_order) *
            C.middleCols(part.local, part.count);
  }
  if (with_M) K += weights.mass * M;
}

/// The same where nodes are held in some directions or carried by others: sum <- the entries along independent
/// increments, columns first, over all local rows; then rows.
void System::add_related(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                         const Component& component, const VectorX* dq, Workspace& work) const {
  const int n = local.slots().size(), reduced = static_cast<int>(placement.unknown.size());
  using Map = Eigen::Map<MatrixX>;
  Map K(work.K.data(), n, n), C(work.C.data(), n, n), M(work.M.data(), n, n), sum(work.sum.data(), reduced, reduced),
      columns(work.columns.data(), n, reduced);
  const State& state = local.global();
  std::vector<NodeRelation>& relation = work.relation;
  relation.resize(std::max(relation.size(), placement.nodes.size()));
  for (std::size_t k = 0; k < placement.nodes.size(); ++k)
    relation[k] = relate(kinematics_, placement.nodes[k].node, state, dq);
  for (const ScalarPart& part : placement.scalars) {
    auto to = columns.middleCols(part.reduced, part.count);
    to = K.middleCols(part.local, part.count);
    if (part.kind == Kind::multiplier) continue;
    to += weights.mass * M.middleCols(part.local, part.count);
    to += (part.kind == Kind::amplitude ? weights.damping : weights.first_order) * C.middleCols(part.local, part.count);
  }
  bool any_carried = false;
  for (std::size_t k = 0; k < placement.nodes.size(); ++k) {
    const NodeRelation& node = relation[k];
    const Eigen::Index count = node.displacement.cols(), at = placement.nodes[k].local;
    auto part = columns.middleCols(placement.nodes[k].reduced, count);
    const auto Kk = K.middleCols<6>(at), Ck = C.middleCols<6>(at), Mk = M.middleCols<6>(at);
    part.noalias() = Kk * node.displacement_step;
    part.noalias() += Ck * (weights.damping * node.displacement);
    part.noalias() += Mk * (weights.mass * node.displacement);
    if (!node.carried) continue;
    any_carried = true;
    part.noalias() += Ck * (weights.stiffness * node.rate_of_displacement);
    part.noalias() += Mk * (weights.stiffness * node.acceleration_of_displacement);
    part.noalias() += Mk * (weights.damping * node.acceleration_of_rate);
  }
  for (const ScalarPart& part : placement.scalars)
    sum.middleRows(part.reduced, part.count) = columns.middleRows(part.local, part.count);
  for (std::size_t k = 0; k < placement.nodes.size(); ++k)
    sum.middleRows(placement.nodes[k].reduced, relation[k].displacement.cols()).noalias() =
        relation[k].displacement.transpose() * columns.middleRows<6>(placement.nodes[k].local);
  if (!any_carried) return;
  auto r = work.r.head(n);
  r.setZero();
  component.add_residual(local, r);
  for (const NodePart& part : placement.nodes) {
    const Carry* carry = kinematics_.carry(part.node);
    if (!carry) continue;
    const NodeFreedom& f = kinematics_.freedom(carry->carrier);
    const Matrix3& R = state.nodes[static_cast<std::size_t>(carry->carrier)].R;
    const Matrix3 turn = skew(carry->c) * skew(R.transpose() * r.segment<3>(part.local));
    const Matrix6X G = f.G.leftCols(f.count);
    const Matrix6X GT = times_step_tangent(G, f, dq);
    sum.block(part.reduced, part.reduced, f.count, f.count).noalias() +=
        weights.stiffness * (G.bottomRows<3>().transpose() * turn * GT.bottomRows<3>());
  }
}

void System::tangent(const State& state, const Environment& environment, const TangentWeights& weights,
                     const VectorX* dq, std::vector<double>& values) const {
  thread_local std::unique_ptr<Workspace> work;
  if (!work || work->r.size() < largest_local_) work = std::make_unique<Workspace>(largest_local_);
  values.assign(static_cast<std::size_t>(pattern_.entry_count()), 0.0);
  if (weights.velocity_level) work->probe = state;
  if (dq) {
    work->step_tangent.resize(state.nodes.size());
    for (const auto [node, begin] : kinematics_.all_free())
      work->step_tangent[node] = mechanism::tangent(dq->segment<3>(begin + 3));
  }
  for (const std::size_t m : acting_) {
    const Placement& placement = placements_[m];
    if (placement.targets.empty()) continue;
    const LocalState local(state, slots_[m], environment);
    const Component& component = *model_.members()[m].component;
    if (placement.in_blocks && !weights.velocity_level)
      add_in_place(placement, local, weights, component, dq ? work->step_tangent.data() : nullptr, values);
    else
      add_reduced(placement, local, weights, component, dq, *work, values);
  }
  for_each_idle(state, [&](int multiplier) {
    const IdlePlaces& places = idle_places_[static_cast<std::size_t>(multiplier)];
    for (const int place : places.entries) values[static_cast<std::size_t>(place)] = 0;
    values[static_cast<std::size_t>(places.diagonal)] = 1;
  });
}

}  // namespace bielle::mechanism
