// If reactions are not unique, those of the smallest norm among all multipliers with the same forces are computed.
//
// If constraints are redundant, the motion determines the forces f = B^T lambda on the unknowns, but not lambda. The
// reactions that are reported, and read by forces that depend on reactions, are the solution of
//     min sum over joints of |F|^2 + |M|^2 / L^2 = lambda^T H lambda,   B^T lambda = f,
// Here F and M are the wrench of each joint at its attachment point (Component::add_reaction_norm), and L is the arm of
// the redundancy analysis. The solution does not depend on the order of rows, the axes of joints, the origin or units;
// equal joints get equal reactions if the mechanism is symmetric. With B of all constraints that are switched on,
// including redundant ones, it is the limit delta -> 0 of
//     [D B^T; B -delta H] [u; lambda] = [f; 0],   D > 0 any diagonal,
// computed to rounding by two or three iterations of the method of multipliers: one sparse factorisation whose pattern
// is known from the start. (M. Hestenes, J. Optim. Theory Appl. 4 (1969) 303.)
#pragma once

#include <memory>
#include <vector>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class ReactionNorm {
 public:
  explicit ReactionNorm(const System& system);

  /// Returns whether a state has redundant constraints.
  static bool needed(const System& system, const State& state);
  /// Sets the state's `reaction`; empties it if no constraint is redundant.
  void balance(const Environment& environment, State& state);
  /// Returns the multipliers that are not unique at a state, ascending.
  std::vector<int> not_unique(const Environment& environment, const State& state);

 private:
  void find_entries();
  void factor(const Environment& environment, const State& state);
  VectorX smallest(const VectorX& multiplier) const;

  const System& system_;
  SparsePattern pattern_;
  SparseLU factors_;
  std::shared_ptr<const TangentPattern> of_;  ///< the system's pattern
  std::vector<int> from_;                     ///< places in this matrix of each of its entries, -1 if it has none
  std::vector<int> norm_begin_;               ///< for each member, first index in the list of places of its H
  std::vector<int> norm_places_;
  std::vector<int> diagonal_;  ///< places of D
  std::vector<double> tangent_, values_;
  VectorX scale_, diagonal_values_;
};

/// Computes the values of a system's event functions, with the reactions of smallest norm if they read reactions.
class EventFunctionValues {
 public:
  explicit EventFunctionValues(const System& system) : system_(system) {}
  /// Sets the reactions that a state's event functions read, if they differ from its multipliers.
  /// @returns whether reactions were set
  bool balance(const Environment& environment, State& state);
  /// @param values  (system.event_functions().size())
  void calc(const State& state, const Environment& environment, Eigen::Ref<VectorX> values);
  double calc(const State& state, const Environment& environment, int event_function);  ///< value of one of them

 private:
  bool needs(const State& state) const;
  const System& system_;
  std::unique_ptr<ReactionNorm> norm_;  ///< created when necessary
};

/// The reactions that forces read: they must be updated before every residual of a system with such forces.
class ReadReactions {
 public:
  explicit ReadReactions(const System& system) : system_(system) {}
  /// Sets the state's `reaction` if forces read reactions and constraints are redundant; otherwise empties it, so that
  /// no reactions of another state are read.
  void balance(const Environment& environment, State& state);
  /// Discards earlier factorisations, so that later results do not depend on them.
  void begin_anew() { norm_.reset(); }

 private:
  const System& system_;
  std::unique_ptr<ReactionNorm> norm_;  ///< created when necessary
};

}  // namespace bielle::mechanism
