#include "mechanism/system/member_tangent.hpp"

#include <algorithm>

namespace bielle::mechanism {
namespace {

/// Multiplies three columns of A, from `first` on, by T.
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

TangentWorkspace::TangentWorkspace(int n) {
  const auto size = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  for (auto* buffer : {&K, &C, &M, &columns, &sum}) buffer->resize(size);
  r.resize(n);
}

MemberTangent::MemberTangent(const TangentRequest& request, const LocalToGlobal& placement, const LocalState& local,
                             const Component& component, TangentWorkspace& work)
    : kinematics_(request.kinematics),
      weights_(request.weights),
      dq_(request.dq),
      turns_(request.turns),
      work_(work),
      placement_(placement),
      local_(local),
      component_(component),
      slots_(local.slots()),
      n_(slots_.size()),
      K_(matrix(work_.K)),
      C_(matrix(work_.C)),
      M_(matrix(work_.M)) {}

void MemberTangent::add_to(std::vector<double>& values) {
  if (const double* entries = reduced()) placement_.scatter(entries, values);
}

const double* MemberTangent::reduced() {
  choose();
  const bool nothing =
      weights_.velocity_level ? slots_.multipliers == 0 : !wants_K_ && !wants_C_ && !wants_M_ && placement_.plain;
  if (nothing) return nullptr;
  evaluate();
  if (rate_rows_) use_rate_rows();
  if (wants_K_) weigh_stiffness();
  if (placement_.plain) {
    reduce_plain();
    return K_.data();
  }
  reduce_related();
  return work_.sum.data();
}

/// Chooses the matrices that are necessary. Convective terms of carried nodes add C and M to the stiffness: then all
/// three are necessary.
void MemberTangent::choose() {
  const TangentWeights& w = weights_;
  wants_K_ = placement_.stiffness && (w.stiffness != 0 || (w.constraint != 0 && slots_.multipliers > 0) ||
                                      (w.reactions && placement_.reads_multipliers));
  const bool rates_in_K = !placement_.plain && w.stiffness != 0;
  rate_rows_ = w.acceleration_level && !placement_.nonholonomic.empty();
  wants_C_ = placement_.damping && (rates_in_K || w.damping != 0 || w.first_order != 0 || rate_rows_);
  wants_M_ = placement_.mass && (rates_in_K || w.mass != 0 || w.damping != 0);
}

void MemberTangent::evaluate() {
  const auto clear = [&](std::vector<double>& buffer) { std::fill_n(buffer.begin(), n_ * n_, 0.0); };
  clear(work_.K);
  if (wants_C_ || weights_.velocity_level || !placement_.plain) clear(work_.C);
  if (wants_M_ || !placement_.plain) clear(work_.M);
  if (weights_.velocity_level) {
    set_velocity_rows();
    return;
  }
  const auto target = [&](Map& matrix) { return LocalMatrix(matrix, placement_.blocks_only); };
  LocalTangent tangent{target(K_), target(C_), target(M_), wants_K_, wants_C_, wants_M_};
  component_.add_tangent(local_, tangent);
}

void MemberTangent::use_rate_rows() {
  for (const int row : placement_.nonholonomic) {
    K_.row(row) = C_.row(row);
    C_.row(row).setZero();
  }
}

/// Multiplies K by the weights: own rows and columns of constraints by `constraint`, the rest by `stiffness`.
void MemberTangent::weigh_stiffness() {
  if (slots_.referenced > 0) {
    weigh_with_references();
    return;
  }
  const int own = slots_.multiplier_row(), multipliers = slots_.multipliers;
  if (weights_.stiffness != 1) K_.topLeftCorner(own, own) *= weights_.stiffness;
  if (weights_.constraint == 1) return;
  K_.bottomRows(multipliers) *= weights_.constraint;
  K_.topRightCorner(own, multipliers) *= weights_.constraint;
}

/// Does the same for a component with references; derivatives by the multipliers of other components have their own
/// weight.
void MemberTangent::weigh_with_references() {
  const int own = slots_.multiplier_row(), multipliers = slots_.multipliers;
  const double reaction = weights_.reactions ? 1 : weights_.stiffness;
  const auto weigh_columns = [&](int begin, int count, double weight) {
    auto columns = K_.middleCols(begin, count);
    columns.topRows(own) *= weight;
    columns.middleRows(own, multipliers) *= weights_.constraint;
    columns.bottomRows(n_ - own - multipliers) *= weight;
  };
  weigh_columns(0, own, weights_.stiffness);
  weigh_columns(own, multipliers, weights_.constraint);
  for (const NodePart& part : placement_.nodes)
    if (part.local >= placement_.own_size) weigh_columns(part.local, 6, weights_.stiffness);
  for (const ScalarPart& part : placement_.scalars)
    if (!part.own) weigh_columns(part.local, part.count, part.kind == Kind::multiplier ? reaction : weights_.stiffness);
}

/// K <- K T(Dq) + damping C + mass M; columns of first-order unknowns have their own weight of C.
void MemberTangent::reduce_plain() {
  if (dq_ && wants_K_)
    for (const NodePart& part : placement_.nodes)
      if (kinematics_.freedom(part.node).all_free) multiply_columns(K_, part.local + 3, turns_[part.node]);
  if (wants_C_ || weights_.velocity_level) {
    // Own nodes are contiguous: most components have no others.
    const int own_rows = placement_.own_nodes_end;
    K_.leftCols(own_rows) += weights_.damping * C_.leftCols(own_rows);
    for (const NodePart& part : placement_.nodes)
      if (part.local >= placement_.own_size)
        K_.middleCols<6>(part.local) += weights_.damping * C_.middleCols<6>(part.local);
    for (const ScalarPart& part : placement_.scalars)
      if (part.kind != Kind::multiplier)
        K_.middleCols(part.local, part.count) += rate_weight(part.kind) * C_.middleCols(part.local, part.count);
  }
  if (wants_M_ && !weights_.velocity_level) K_ += weights_.mass * M_;
}

/// Reduces K, C and M if nodes are held in some directions or carried by others. The sum contains the entries along
/// independent increments: first the columns are reduced, over all local rows; then the rows.
void MemberTangent::reduce_related() {
  std::vector<NodeRelation>& relation = work_.relation;
  relation.resize(std::max(relation.size(), placement_.nodes.size()));
  bool any_carried = false;
  for (std::size_t k = 0; k < placement_.nodes.size(); ++k) {
    relation[k] = relate(kinematics_, placement_.nodes[k].node, local_.global(), dq_);
    any_carried = any_carried || relation[k].carried;
  }
  relate_columns();
  relate_rows();
  if (any_carried) add_turning_of_arms();
}

void MemberTangent::relate_columns() {
  Map columns(work_.columns.data(), n_, placement_.reduced_size());
  for (const ScalarPart& part : placement_.scalars) {
    auto to = columns.middleCols(part.reduced, part.count);
    to = K_.middleCols(part.local, part.count);
    if (part.kind == Kind::multiplier) continue;
    to += weights_.mass * M_.middleCols(part.local, part.count);
    to += rate_weight(part.kind) * C_.middleCols(part.local, part.count);
  }
  for (std::size_t k = 0; k < placement_.nodes.size(); ++k) {
    const NodeRelation& node = work_.relation[k];
    const Eigen::Index at = placement_.nodes[k].local;
    auto part = columns.middleCols(placement_.nodes[k].reduced, node.displacement.cols());
    const auto K = K_.middleCols<6>(at), C = C_.middleCols<6>(at), M = M_.middleCols<6>(at);
    part.noalias() = K * node.displacement_step;
    part.noalias() += C * (weights_.damping * node.displacement);
    part.noalias() += M * (weights_.mass * node.displacement);
    if (!node.carried) continue;
    part.noalias() += C * (weights_.stiffness * node.rate_of_displacement);
    part.noalias() += M * (weights_.stiffness * node.acceleration_of_displacement);
    part.noalias() += M * (weights_.damping * node.acceleration_of_rate);
  }
}

void MemberTangent::relate_rows() {
  const int reduced = placement_.reduced_size();
  const Map columns(work_.columns.data(), n_, reduced);
  Map sum(work_.sum.data(), reduced, reduced);
  for (const ScalarPart& part : placement_.scalars)
    sum.middleRows(part.reduced, part.count) = columns.middleRows(part.local, part.count);
  for (std::size_t k = 0; k < placement_.nodes.size(); ++k) {
    const Matrix6X6& displacement = work_.relation[k].displacement;
    sum.middleRows(placement_.nodes[k].reduced, displacement.cols()).noalias() =
        displacement.transpose() * columns.middleRows<6>(placement_.nodes[k].local);
  }
}

/// Adds the terms due to the rotation of the arms at which the member's forces act on the carriers of its nodes.
void MemberTangent::add_turning_of_arms() {
  Map sum(work_.sum.data(), placement_.reduced_size(), placement_.reduced_size());
  auto r = work_.r.head(n_);
  r.setZero();
  component_.add_residual(local_, r);
  for (const NodePart& part : placement_.nodes) {
    const Carry* carry = kinematics_.carry(part.node);
    if (!carry) continue;
    const NodeFreedom& f = kinematics_.freedom(carry->carrier);
    const Matrix3& R = local_.global().nodes[static_cast<std::size_t>(carry->carrier)].R;
    const Matrix3 turn = skew(carry->c) * skew(R.transpose() * r.segment<3>(part.local));
    const Matrix6X6 G = f.G.leftCols(f.count);
    const Matrix6X6 GT = times_step_tangent(G, f, dq_);
    sum.block(part.reduced, part.reduced, f.count, f.count).noalias() +=
        weights_.stiffness * (G.bottomRows<3>().transpose() * turn * GT.bottomRows<3>());
  }
}

}  // namespace bielle::mechanism
