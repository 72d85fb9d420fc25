// Assembly of the global residual from those of the components: local forces are added node by node, carried nodes
// transfer theirs to their carriers, and G^T selects the free directions.
#pragma once

#include <vector>

#include "mechanism/system/shared_work.hpp"

namespace bielle::mechanism {

class ResidualAssembly {
 public:
  /// The object keeps references to its arguments.
  ResidualAssembly(const Model& model, const NodeKinematics& kinematics, const Unknowns& unknowns,
                   const SharedWork& work)
      : model_(model), kinematics_(kinematics), unknowns_(unknowns), work_(work) {}
  ResidualAssembly(const ResidualAssembly&) = delete;
  ResidualAssembly& operator=(const ResidualAssembly&) = delete;

  /// Adds the nodes that the next member of the model declares.
  void add(const Declaration& declaration);
  /// Call it when all members are numbered and the costly ones are known.
  void complete();

  /// Computes r (size) of all equations, those of idle constraints as if they were active.
  /// @param scale  if given, receives the largest contributions
  void add_all(const State& state, const Environment& environment, Eigen::Ref<VectorX> r, ResidualScale* scale) const;
  /// Sets r (size) to the part of one member.
  void set_part(std::size_t member, const State& state, const Environment& environment, Eigen::Ref<VectorX> r) const;
  /// Power [W] of the supports that prescribe motions of nodes.
  double support_power(const State& state, const Environment& environment) const;

 private:
  struct Largest;
  class Sums;
  /// A member that adds to the equations.
  struct Acting {
    std::size_t member;
    std::size_t nodes_begin;  ///< index of its first node in force_rows_
  };
  void node_forces(const State& state, const Environment& environment, VectorX& forces, Eigen::Ref<VectorX> r,
                   ResidualScale* scale) const;
  static void hold_first_order(const LocalState& state, Eigen::Ref<VectorX> local);
  void evaluate(std::size_t member, const State& state, const Environment& environment,
                Eigen::Ref<VectorX> local) const;
  void add_small(const State& state, const Environment& environment, Sums& sums) const;
  void add_referenced(const Slots& slots, const double* part, VectorX& forces, Eigen::Ref<VectorX> r,
                      ResidualScale& scale) const;
  void set_scale(const Largest& largest, const Eigen::Ref<VectorX>& r, ResidualScale& scale) const;

  const Model& model_;
  const NodeKinematics& kinematics_;
  const Unknowns& unknowns_;
  const SharedWork& work_;
  std::size_t members_ = 0;
  std::vector<Acting> small_, costly_;  ///< costly members are in the order of SharedWork
  std::vector<int> force_rows_;         ///< NodeKinematics::force_row of the nodes, member after member
};

}  // namespace bielle::mechanism
