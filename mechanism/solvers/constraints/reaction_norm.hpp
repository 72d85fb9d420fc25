// Reactions where they are not unique: of all multipliers that make the same forces, those of the smallest norm.
//
// Where constraints repeat each other, the motion fixes the forces f = B^T lambda on the unknowns, not lambda itself.
// Reported, and read by forces that depend on reactions, is the solution of
//     min sum over joints of |F|^2 + |M|^2 / L^2 = lambda^T H lambda,   B^T lambda = f,
// F and M the wrench of each joint at its attachment point (Component::add_reaction_norm), L the arm of the redundancy
// analysis. It does not depend on the order of rows, the axes of joints, the origin or units; equal joints get equal
// reactions where symmetry demands it. With B over all constraints that are on, redundant ones included, it is the
// limit delta -> 0 of
//     [D B^T; B -delta H] [u; lambda] = [f; 0],   D > 0 any diagonal,
// reached to rounding by two or three iterations of the method of multipliers: one sparse factorisation whose pattern
// is known from the start. (M. Hestenes, J. Optim. Theory Appl. 4 (1969) 303.)
#pragma once

#include <memory>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class ReactionNorm {
 public:
  explicit ReactionNorm(const System& system);

  /// Whether a state has redundant constraints at all.
  static bool needed(const System& system, const State& state);
  /// Sets the state's `reaction`; empties it where nothing is redundant.
  void balance(const Environment& environment, State& state);
  /// Multipliers that are not unique at a state, ascending.
  std::vector<int> not_unique(const Environment& environment, const State& state);

 private:
  void factor(const Environment& environment, const State& state);
  VectorX smallest(const VectorX& multiplier) const;

  const System& system_;
  SparsePattern pattern_;
  SparseLU factors_;
  std::vector<int> from_;        ///< of each entry of the system's pattern: its place here, -1 where it has none
  std::vector<int> norm_begin_;  ///< of each member: where the places of its H begin
  std::vector<int> norm_places_;
  std::vector<int> diagonal_;  ///< places of D
  std::vector<double> tangent_, values_;
  VectorX scale_, diagonal_values_;
};

/// Values of a system's crossings, with the reactions of smallest norm where they read reactions.
class CrossingValues {
 public:
  explicit CrossingValues(const System& system) : system_(system) {}
  /// Gives a state the reactions that its crossings read, where that are others than its multipliers.
  /// @returns whether it has
  bool balance(const Environment& environment, State& state);
  /// @param values  (system.crossings().size())
  void calc(const State& state, const Environment& environment, Eigen::Ref<VectorX> values);
  double calc(const State& state, const Environment& environment, int crossing);  ///< one of them

 private:
  bool needs(const State& state) const;
  const System& system_;
  std::unique_ptr<ReactionNorm> norm_;  ///< made where it is needed
};

/// The reactions that forces read: to be updated before every residual of a system with such forces.
class ReadReactions {
 public:
  explicit ReadReactions(const System& system) : system_(system) {}
  /// Sets the state's `reaction` where forces read reactions and constraints are redundant; empties it otherwise, so
  /// that none is read that belongs to another state.
  void balance(const Environment& environment, State& state);
  /// What comes next owes nothing to factorisations of before.
  void begin_anew() { norm_.reset(); }

 private:
  const System& system_;
  std::unique_ptr<ReactionNorm> norm_;  ///< made where it is needed
};

}  // namespace bielle::mechanism
