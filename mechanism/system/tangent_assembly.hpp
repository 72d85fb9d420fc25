// Assembly of the global tangent from those of the components: its pattern, and its values.
//
// Components of pairs (CoupledPairs) have entries of the pairs that were near when the pattern was built. If another
// pair acts, the pattern is built again, with all pairs that are near then.
#pragma once

#include <memory>
#include <vector>

#include "mechanism/system/local_to_global.hpp"
#include "mechanism/system/member_tangent.hpp"
#include "mechanism/system/pair_tangents.hpp"
#include "mechanism/system/shared_work.hpp"
#include "mechanism/system/tangent_pattern.hpp"
#include "mechanism/system/tangent_weights.hpp"

namespace bielle::mechanism {

class TangentAssembly {
 public:
  /// The object keeps references to its arguments.
  TangentAssembly(const Model& model, const NodeKinematics& kinematics, const Unknowns& unknowns,
                  const SharedWork& work)
      : model_(model), kinematics_(kinematics), unknowns_(unknowns), work_(work) {}
  TangentAssembly(const TangentAssembly&) = delete;
  TangentAssembly& operator=(const TangentAssembly&) = delete;

  /// Adds the properties that the next member of the model declares.
  void add(const Declaration& declaration) { placements_.emplace_back(declaration); }
  /// Call it when all members are numbered.
  void complete();
  /// Finds the global pattern and the places of all entries.
  /// @param may_be_idle  multipliers whose diagonal entries are required
  void build_pattern(const std::vector<bool>& may_be_idle);
  /// Builds the pattern again without any pair. @returns whether there were pairs
  bool forget_pairs();

  const std::shared_ptr<const TangentPattern>& pattern() const { return pattern_; }
  /// Amplitudes of each member that couple only to the member's own unknowns, ascending.
  std::vector<std::vector<int>> lone_amplitudes() const;
  /// Computes the values in the pattern's order; idle constraints are treated as if they were active.
  /// @param dq  increment since the base of the step, for T(Dq); nullptr: zero
  /// @returns whether the pattern was built again
  bool set_values(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                  std::vector<double>& values);

 private:
  class KeptEntries;
  void find_lone_amplitudes();
  void build_pattern();
  void find_intermittent(const KeptEntries& kept, SparsePattern& pattern) const;
  void set_places(const KeptEntries& kept, std::size_t member);
  bool set_values_of_members(const State& state, const Environment& environment, const TangentWeights& weights,
                             const VectorX* dq, std::vector<double>& values);
  void add_held(const State& state, const Environment& environment, const TangentWeights& weights,
                std::vector<double>& values) const;
  bool add_values(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                  std::vector<double>& values) const;
  bool add_small(const State& state, const Environment& environment, const TangentRequest& request,
                 std::vector<double>& values) const;
  const PairTangents* pairs_of(std::size_t member) const {
    const int pairs = number_of_pairs_[member];
    return pairs < 0 ? nullptr : &pairs_[static_cast<std::size_t>(pairs)];
  }
  void add_in_place(const LocalToGlobal& placement, const LocalState& local, const TangentWeights& weights,
                    const Component& component, const Matrix3* turns, std::vector<double>& values) const;

  const Model& model_;
  const NodeKinematics& kinematics_;
  const Unknowns& unknowns_;
  const SharedWork& work_;
  std::vector<LocalToGlobal> placements_;  ///< placement of each member
  std::vector<std::size_t> small_;         ///< members that have entries and are not costly
  std::vector<std::size_t> waiting_;       ///< buffer for entries of the costly members to whose places others may add
  std::vector<PairTangents> pairs_;        ///< those of the members of pairs
  std::vector<std::size_t> pairs_member_;  ///< their members
  std::vector<int> number_of_pairs_;       ///< for each member its index among them, -1: it has none
  std::vector<int> held_when_released_;    ///< first-order unknowns that keep their values if their entry is released
  int largest_local_ = 0;                  ///< size of the largest local matrix
  std::vector<bool> may_be_idle_;
  std::shared_ptr<const TangentPattern> pattern_;
};

}  // namespace bielle::mechanism
