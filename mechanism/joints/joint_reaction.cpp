// The reaction of a joint in the axes of its frame, from the terms that the joint adds to the equations of its second
// node: its multipliers, or, if it has none, its elastic and other forces.
//
// With f and m the rows that the joint adds to the force and moment equations of node 2 (inertial axes, node axes), the
// joint exerts -f and -m. About the attachment point c on node 2, along the axes of the frame A on node 1:
//     F = -A^T R_1^T f,     M = A^T R_12 N,   N = -m + c x R_2^T f,   R_12 = R_1^T R_2.
#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"
#include "mechanism/joints/joint_measures.hpp"
#include "mechanism/measures/nested.hpp"
#include "reduce/common/direction_words.hpp"

namespace bielle::mechanism {
namespace {

constexpr int second_node = 6;  ///< its first local row

/// The wrench from rows [f; m].
struct Wrench {
  Matrix3 A, R_1, R_2, R_12;
  Vector3 c;
  Wrench(const JointFrames& frames, const NodeState& first, const NodeState& second)
      : A(frames.on_first.R),
        R_1(first.R),
        R_2(second.R),
        R_12(first.R.transpose() * second.R),
        c(frames.on_second.x) {}
  Vector3 moment_on_second(const Vector3& f, const Vector3& m) const { return -m + c.cross(R_2.transpose() * f); }
  Vector6 of(const Vector6& rows) const {
    Vector6 wrench;
    wrench << -A.transpose() * (R_1.transpose() * rows.head<3>()),
        A.transpose() * (R_12 * moment_on_second(rows.head<3>(), rows.tail<3>()));
    return wrench;
  }
};

/// The joint's K, which contains B^T in the columns of multipliers, or its C. Each object has its own memory, because
/// the forces of a bushing with a film may depend on the reaction of another joint, which is computed meanwhile.
class JointTangent {
 public:
  JointTangent(const Joint& joint, const LocalState& state, bool by_rates = false)
      : A_(begin(state.slots().size()), state.slots().size(), state.slots().size()) {
    MatrixX none(0, 0);
    LocalTangent tangent{by_rates ? LocalMatrix(none) : LocalMatrix(A_),
                         by_rates ? LocalMatrix(A_) : LocalMatrix(none),
                         LocalMatrix(none),
                         !by_rates,
                         by_rates,
                         false};
    joint.add_tangent(state, tangent);
  }
  const Eigen::Map<MatrixX>& operator*() const { return A_; }

 private:
  double* begin(int n) {
    buffer_->assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0);
    return buffer_->data();
  }
  Nested<std::vector<double>, Joint> buffer_;
  Eigen::Map<MatrixX> A_;
};

/// Computes the rows that the joint adds to the equations of its second node.
Vector6 second_rows(const Joint& joint, const LocalState& state) {
  Nested<VectorX, Joint> r;
  r->setZero(state.slots().size());
  joint.add_residual(state, *r);
  return r->segment<6>(second_node);
}

}  // namespace

MatrixX Joint::reaction_of_multipliers(const LocalState& state) const {
  const Slots& slots = state.slots();
  const JointTangent tangent(*this, state);
  const auto& K = *tangent;
  const Wrench wrench(frames_, state.node(0), state.node(1));
  MatrixX result(6, slots.multipliers);
  for (int k = 0; k < slots.multipliers; ++k)
    result.col(k) = wrench.of(K.block<6, 1>(second_node, slots.multiplier_row() + k));
  return result;
}

void Joint::add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const {
  MatrixX wrench = reaction_of_multipliers(state);
  wrench.bottomRows<3>() /= arm;
  H += wrench.transpose() * wrench;
}

Vector6 Joint::calc_reaction(const LocalState& state) const {
  if (state.global().reaction.size() > 0 && state.slots().multipliers > 0)
    return reaction_of_multipliers(state) * state.reaction();
  return Wrench(frames_, state.node(0), state.node(1)).of(second_rows(*this, state));
}

Vector6 Joint::calc_reaction(const LocalState& state, MatrixX& derivatives) const {
  const Slots& slots = state.slots();
  const JointTangent tangent(*this, state);
  const auto& K = *tangent;
  const Wrench w(frames_, state.node(0), state.node(1));
  Vector6 rows;
  if (slots.multipliers > 0) {
    rows = K.block(second_node, slots.multiplier_row(), 6, slots.multipliers) * state.reaction();
  } else {
    rows = second_rows(*this, state);
  }
  const Vector3 f = rows.head<3>(), N = w.moment_on_second(f, rows.tail<3>());
  const Vector3 f_1 = w.R_1.transpose() * f, f_2 = w.R_2.transpose() * f;
  const auto df = K.middleRows<3>(second_node), dm = K.middleRows<3>(second_node + 3);
  // d(R_1^T f) = R_1^T df + f_1~ dTheta_1
  derivatives.resize(6, slots.size());
  auto dF = derivatives.topRows<3>();
  dF.noalias() = -w.R_1.transpose() * df;
  dF.middleCols<3>(3) -= skew(f_1);
  // dN = -dm + c~ (R_2^T df + f_2~ dTheta_2);   d(R_12 N) = R_12 (dN - N~ dTheta_2) + (R_12 N)~ dTheta_1
  auto dM = derivatives.bottomRows<3>();
  dM = -dm;
  dM.noalias() += skew(w.c) * w.R_2.transpose() * df;
  dM.middleCols<3>(9) += skew(w.c) * skew(f_2) - skew(N);
  dM = (w.R_12 * dM).eval();
  dM.middleCols<3>(3) += skew(w.R_12 * N);
  derivatives.topRows<3>() = (w.A.transpose() * derivatives.topRows<3>()).eval();
  derivatives.bottomRows<3>() = (w.A.transpose() * derivatives.bottomRows<3>()).eval();
  return w.of(rows);
}

void Joint::calc_reaction_by_rates(const LocalState& state, MatrixX& derivatives) const {
  const JointTangent tangent(*this, state, true);
  const auto& C = *tangent;
  const Wrench wrench(frames_, state.node(0), state.node(1));
  derivatives.resize(6, state.slots().size());
  for (Eigen::Index k = 0; k < C.cols(); ++k) derivatives.col(k) = wrench.of(C.block<6, 1>(second_node, k));
}

std::vector<std::string> Joint::measure_names() const {
  std::vector<std::string> names;
  for (const JointCoordinate& each : coordinates_) {
    names.push_back(each.name);
    names.push_back(each.name + ".rate");
  }
  for (const char* direction : direction_words) names.push_back(std::string("reaction.") + direction);
  return names;
}

std::unique_ptr<Measure> Joint::make_measure(const std::string& name, const std::string& measure) const {
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    if (measure == coordinates_[k].name) return std::make_unique<CoordinateMeasure>(name, *this, k);
    if (measure == coordinates_[k].name + ".rate") return std::make_unique<CoordinateRateMeasure>(name, *this, k);
  }
  for (int k = 0; k < 6; ++k)
    if (measure == std::string("reaction.") + direction_words[static_cast<std::size_t>(k)])
      return std::make_unique<ReactionMeasure>(name, *this, k);
  return Component::make_measure(name, measure);
}

}  // namespace bielle::mechanism
