// The equations by which parts are brought together: constraints and conditions of a start, linearised, with the
// stiffness of elastic bodies.
//
//   [K + e D   B^T ] [dq]     [f(q) - f_drawn]       Rows of B: those of all constraints that take part, then one of
//   each [B         -C  ] [mu] = - [Phi + C mu_0  ]       start value and kept coordinate.
//
// K and f are the elastic stiffness and forces, D the mean of K over each kind of dof: with a small e bodies move
// rigidly rather than bend. C >= 0 is diagonal: tiny, it lets constraints repeat each other; larger, it damps the step
// (Levenberg and Marquardt). mu_0 are multipliers that are known already: with them C leaves no trace (Hestenes' method
// of multipliers). Dofs of kept nodes stand still.
//
// Gaps are measured in metres, whatever a row compares: Phi_i^2 / (sum of B_ij^2 by translations, and B_ij^2 / l^2 by
// rotations), l half the mechanism's extent; it is how far nodes have to move, about, to mend the row alone.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Which constraints take part.
struct TakingPart {
  bool nonholonomic = true;  ///< their B dq = 0: what has a given rate stays where it is
  bool set_aside = true;     ///< those that repeat others, too
};

class ClosingEquations {
 public:
  /// @param state  as drawn: sizes and forces are taken there
  ClosingEquations(const System& system, const Environment& environment, const State& state,
                   const StartConditions& conditions, const TakingPart& who);

  int rows() const { return static_cast<int>(weights_.size()); }  ///< of constraints, then of conditions
  bool takes_part(int row) const { return active_[static_cast<std::size_t>(row)]; }
  /// Whether one of the constraints is non-holonomic.
  bool any_nonholonomic() const { return any_nonholonomic_; }
  /// The state with the constraints in the equations that take part.
  State taken(const State& state) const;

  /// How far a state is from closed.
  struct Gaps {
    VectorX values;      ///< Phi [m or rad], (rows)
    double worst = 0;    ///< relative to the size of its constraint; NaN where there are no numbers
    int worst_row = -1;  ///< -1: all vanish
    double squared = 0;  ///< sum of the squared gaps [m^2]
  };
  Gaps measure(const State& state) const;
  /// One gap in metres.
  double gap(int row, double value) const { return std::abs(value) * std::sqrt(weights_[row]); }
  double weight(int row) const { return weights_[row]; }
  double half_extent() const { return half_extent_; }  ///< l [m]
  double stiffness() const { return stiffness_; }      ///< D of translations at the last assembly

  /// Whether bodies move without any stiffness between them: a way out where stiffness leads nowhere.
  void leave_stiffness_out(bool yes) { bare_ = yes; }
  bool any_stiffness() const { return any_stiffness_ && !bare_; }
  /// A state from which what is the same on both sides of the drawing (links in line) goes to one of them.
  State shaken(const State& state) const;

  /// Assembles at a state. @param forces  multipliers that stretch constraints: their geometric stiffness is part of K
  void assemble(const State& state, const VectorX* forces = nullptr);
  /// @param compliance  C (rows) @param floor  e @returns false when singular
  bool factor(const VectorX& compliance, double floor);
  /// @param phi  right-hand side of the rows, Phi + C mu_0 @param dq (dofs) @param dy  of first-order unknowns
  /// @param mu  (rows)
  void solve(const VectorX& phi, VectorX& dq, VectorX& dy, VectorX& mu) const;
  /// B^T f over all dofs, those of kept nodes included. @param f (rows)
  VectorX forces_on_dofs(const VectorX& f) const;

  const System& system() const { return system_; }
  const StartConditions& conditions() const { return conditions_; }
  /// The condition of a row behind the constraints.
  const CoordinateCondition& condition(int row) const {
    return *valued_[static_cast<std::size_t>(row - system_.multipliers())];
  }
  bool is_condition(int row) const { return row >= system_.multipliers(); }
  const Environment& environment() const { return environment_; }

 private:
  State at_rest(const State& state) const;
  void choose_rows(const TakingPart& who);
  void make_pattern(const State& state);
  void weigh(const State& state);

  const System& system_;
  Environment environment_, unloaded_;
  const StartConditions& conditions_;
  std::vector<const CoordinateCondition*> valued_;  ///< conditions with a value
  std::vector<StartCoordinate> coordinates_;        ///< theirs
  std::vector<bool> active_;                        ///< rows
  std::vector<bool> still_;                         ///< dofs of kept nodes
  std::vector<char> idle_;                          ///< State::idle of what does not take part
  bool any_nonholonomic_ = false, any_stiffness_ = false, bare_ = false;
  double half_extent_ = 1, stiffness_ = 1;
  VectorX sizes_, weights_, drawn_;

  SparsePattern pattern_;
  std::unique_ptr<CondensedPattern> condensed_;
  std::unique_ptr<CondensedLU> factors_;
  std::vector<int> from_system_, diagonal_;  ///< places of the system's entries and of the diagonal
  std::vector<double> tangent_, values_, work_;
  VectorX metric_, elastic_;
};

}  // namespace bielle::mechanism
