// The equations that close the gaps between parts: constraints and conditions of a start, linearised, with the
// stiffness of elastic bodies.
//
//   [K + e D   B^T ] [dq]     [f(q) - f_drawn]       Rows of B: those of all constraints that take part, then one of
//   each [B         -C  ] [mu] = - [Phi + C mu_0  ]       start value and kept coordinate.
//
// K and f are the elastic stiffness and forces, D is the mean of K over each kind of dof: with a small e bodies move
// rigidly rather than deform. C >= 0 is diagonal: if tiny, it permits redundant constraints; if larger, it damps the
// step (Levenberg and Marquardt). mu_0 are known multipliers, with which C has no effect on the solution (Hestenes'
// method of multipliers). Dofs of kept nodes are fixed.
//
// Gaps are measured in metres for any kind of row: Phi_i^2 / (sum of B_ij^2 for translations, and B_ij^2 / l^2 for
// rotations), with half the mechanism's extent l; this is approximately the displacement of nodes that closes the row
// alone.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Selects the constraints that are included.
struct TakingPart {
  bool nonholonomic = true;  ///< their rows B dq = 0: nodes with given rates are held
  bool set_aside = true;     ///< redundant constraints are included
};

class ClosingEquations {
 public:
  /// @param state  initial state: sizes and forces are computed there
  ClosingEquations(const System& system, const Environment& environment, const State& state,
                   const StartConditions& conditions, const TakingPart& who);

  int rows() const { return static_cast<int>(weights_.size()); }  ///< rows of constraints, then of conditions
  bool takes_part(int row) const { return active_[static_cast<std::size_t>(row)]; }
  /// Returns whether one of the constraints is non-holonomic.
  bool any_nonholonomic() const { return any_nonholonomic_; }
  /// Returns the state with the included constraints in the equations.
  State taken(const State& state) const;

  /// Gaps of a state.
  struct Gaps {
    VectorX values;      ///< Phi [m or rad], (rows)
    double worst = 0;    ///< largest, relative to the size of its constraint; NaN if some gap is not a number
    int worst_row = -1;  ///< row of the largest; -1: all are zero
    double squared = 0;  ///< sum of the squared gaps [m^2]
  };
  Gaps measure(const State& state) const;
  /// Returns one gap in metres.
  double gap(int row, double value) const { return std::abs(value) * std::sqrt(weights_[row]); }
  double weight(int row) const { return weights_[row]; }
  double half_extent() const { return half_extent_; }  ///< l [m]
  double stiffness() const { return stiffness_; }      ///< D for translations at the last assembly

  /// Sets whether bodies move without stiffness between them: an alternative if the stiffness prevents convergence.
  void leave_stiffness_out(bool yes) { bare_ = yes; }
  bool any_stiffness() const { return any_stiffness_ && !bare_; }
  /// Returns a perturbed state, with which symmetric initial positions (links in line) move to one side.
  State shaken(const State& state) const;

  /// Assembles the matrix at a state. @param forces  multipliers of stretched constraints: their geometric stiffness is
  /// part of K
  void assemble(const State& state, const VectorX* forces = nullptr);
  /// @param compliance  C (rows) @param floor  e @returns false if the matrix is singular
  bool factor(const VectorX& compliance, double floor);
  /// @param phi  right-hand side of the rows, Phi + C mu_0 @param dq (dofs) @param dy  increments of first-order
  ///             unknowns
  /// @param mu  (rows)
  void solve(const VectorX& phi, VectorX& dq, VectorX& dy, VectorX& mu) const;
  /// Returns B^T f over all dofs, including those of kept nodes. @param f (rows)
  VectorX forces_on_dofs(const VectorX& f) const;

  const System& system() const { return system_; }
  const StartConditions& conditions() const { return conditions_; }
  /// Returns the condition of a row after the constraints.
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
  std::vector<StartCoordinate> coordinates_;        ///< their coordinates
  std::vector<bool> active_;                        ///< for each row
  std::vector<bool> still_;                         ///< dofs of kept nodes
  std::vector<char> idle_;                          ///< State::idle of the constraints that are not included
  bool any_nonholonomic_ = false, any_stiffness_ = false, bare_ = false;
  double half_extent_ = 1, stiffness_ = 1;
  VectorX sizes_, weights_, drawn_;

  std::shared_ptr<const TangentPattern> of_;  ///< the system's pattern when this one was made
  SparsePattern pattern_;
  std::unique_ptr<CondensedPattern> condensed_;
  std::unique_ptr<CondensedLU> factors_;
  std::vector<int> from_system_, diagonal_;  ///< places of the system's entries and of the diagonal
  std::vector<double> tangent_, values_, work_;
  VectorX metric_, elastic_;
};

}  // namespace bielle::mechanism
