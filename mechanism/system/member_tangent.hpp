// One member's part of the global tangent, computed by dense local matrices.
//
// With z = (x, R) of a local node, da = W_z dz + W_v dv + A..., see node_kinematics.hpp,
//     dr = (K A + C V + M W_z) G T dp + (C A + M W_v) G dv + M A G da,     rows (A G)^T,
// and the rotation of the arm at fixed force, c~ (R^T f)~ on the carrier's rotations.
#pragma once

#include <vector>

#include "mechanism/system/local_to_global.hpp"
#include "mechanism/system/node_relation.hpp"
#include "mechanism/system/tangent_weights.hpp"

namespace bielle::mechanism {

/// Buffers of one thread: the evaluation of a member allocates no memory.
struct TangentWorkspace {
  std::vector<double> K, C, M, columns, sum;  ///< local matrices, and their reduction in two steps
  VectorX r;
  std::vector<NodeRelation> relation;  ///< relations of a member's nodes
  State probe;                         ///< a copy of the state in which single multipliers are set to one
  /// @param n  number of rows of the largest local vector
  explicit TangentWorkspace(int n);
};

/// The arguments that are the same for all members.
struct TangentRequest {
  const NodeKinematics& kinematics;
  const TangentWeights& weights;
  const VectorX* dq;     ///< increment since the base of the step, for T(Dq); nullptr: zero
  const Matrix3* turns;  ///< T(Dq) of each node that is free in all directions, if dq is given
};

class MemberTangent {
 public:
  /// The object serves one evaluation: all arguments must outlive it.
  MemberTangent(const TangentRequest& request, const LocalToGlobal& placement, const LocalState& local,
                const Component& component, TangentWorkspace& work);
  /// Adds the part to the values of the global tangent.
  void add_to(std::vector<double>& values);
  /// Returns its reduced entries, by columns, in the workspace; nullptr if it has none.
  const double* reduced();

 private:
  using Map = Eigen::Map<MatrixX>;
  Map matrix(std::vector<double>& buffer) { return {buffer.data(), n_, n_}; }
  void choose();
  void evaluate();
  void weigh_stiffness();
  void weigh_with_references();
  void use_rate_rows();
  void reduce_plain();
  void reduce_related();
  void relate_columns();
  void relate_rows();
  void add_turning_of_arms();
  // The following functions are in velocity_rows.cpp:
  void set_velocity_rows();
  void get_velocities(Eigen::Ref<VectorX> v) const;
  void add_probed_stiffness(const LocalState& probed, Map& sum);
  double rate_weight(Kind kind) const { return kind == Kind::amplitude ? weights_.damping : weights_.first_order; }

  const NodeKinematics& kinematics_;
  const TangentWeights& weights_;
  const VectorX* dq_;
  const Matrix3* turns_;
  TangentWorkspace& work_;
  const LocalToGlobal& placement_;
  const LocalState& local_;
  const Component& component_;
  const Slots& slots_;
  int n_;
  Map K_, C_, M_;
  bool wants_K_ = false, wants_C_ = false, wants_M_ = false;
  bool rate_rows_ = false;  ///< rows of non-holonomic constraints contain only their B
};

}  // namespace bielle::mechanism
