// The residual of the whole from those of the components: local forces are added node by node, carried nodes hand
// theirs to their carriers, and G^T keeps the free directions.
#pragma once

#include <vector>

#include "mechanism/system/shared_work.hpp"

namespace bielle::mechanism {

class ResidualAssembly {
 public:
  /// Keeps references.
  ResidualAssembly(const Model& model, const NodeKinematics& kinematics, const Unknowns& unknowns,
                   const SharedWork& work)
      : model_(model), kinematics_(kinematics), unknowns_(unknowns), work_(work) {}
  ResidualAssembly(const ResidualAssembly&) = delete;
  ResidualAssembly& operator=(const ResidualAssembly&) = delete;

  /// Notes what the next member of the model declares.
  void add(const Declaration& declaration);
  /// To be called when all members are numbered and it is known which are costly.
  void complete();

  /// r (size) of all equations, those of idle constraints as if they were active.
  /// @param scale  if given, receives the largest contributions
  void add_all(const State& state, const Environment& environment, Eigen::Ref<VectorX> r, ResidualScale* scale) const;
  /// The part of one member in r (size).
  void set_part(std::size_t member, const State& state, const Environment& environment, Eigen::Ref<VectorX> r) const;
  /// Power [W] of the supports that move nodes.
  double support_power(const State& state, const Environment& environment) const;

 private:
  struct Largest;
  class Sums;
  /// A member that adds to the equations.
  struct Acting {
    std::size_t member;
    std::size_t nodes_begin;  ///< of its nodes among force_rows_
  };
  void node_forces(const State& state, const Environment& environment, VectorX& forces, Eigen::Ref<VectorX> r,
                   ResidualScale* scale) const;
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
  std::vector<Acting> small_, costly_;  ///< these in the order of SharedWork
  std::vector<int> force_rows_;         ///< of their nodes, one member after another: NodeKinematics::force_row
};

}  // namespace bielle::mechanism
