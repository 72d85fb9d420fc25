// Stability of an equilibrium: the inertia of its stiffness for the motions that the constraints allow.
//
// The number of negative eigenvalues of K on the null space of B is read from the pivots of a symmetric factorisation
// (math/negative_directions.hpp); sizes of unknowns are those of their own stiffness, so that the result is independent
// of units.
//
// If the tangent is not symmetric (follower forces, moments about fixed axes, friction), or forces depend on
// first-order unknowns (controllers, hydraulics), stability depends on the motion, and nothing is counted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "mechanism/solvers/newton/newton_matrix.hpp"

namespace bielle::mechanism {

class Stability {
 public:
  /// @param held  stiffness (dofs) that holds indifferent motions, see StaticTangent; null: none
  explicit Stability(const System& system, const VectorX* held = nullptr);

  /// Sets this stiffness from now on.
  void hold(const VectorX& held) { held_ = held; }

  /// Returns the number of independent small motions with negative stiffness at a state at rest; no value if it is not
  /// known.
  /// @param environment  environment of the equilibrium
  std::optional<int> count(const State& state, const Environment& environment);
  /// Returns the reason why the last count is not known, as a clause that names an unknown.
  const std::string& why_not_known() const { return why_not_known_; }

  /// The motion with the smallest stiffness, of either sign.
  struct Mode {
    VectorX shape;         ///< (dofs), with a largest relative displacement, or rotation, of 1
    VectorX force;         ///< (dofs), for unit stiffness along the shape: K shape = stiffness force
    double stiffness = 0;  ///< its sign determines the stability along the shape
    int largest = -1;      ///< the unknown with the largest motion
  };
  /// Computes it by inverse iteration. @returns no value if the tangent is singular
  std::optional<Mode> softest(const State& state, const Environment& environment);
  /// Returns "z at node 'tip'".
  std::string describe(const Mode& mode) const;

 private:
  struct Parts {
    Eigen::SparseMatrix<double> K;               ///< (dofs, dofs)
    Eigen::SparseMatrix<double> B, B_of_forces;  ///< (constraints, dofs): rows of constraints, and columns of reactions
  };
  std::optional<Parts> parts();
  bool is_symmetric(const Parts& parts, const VectorX& sizes, const VectorX& left_over);
  const VectorX* held() const { return held_.size() > 0 ? &held_ : nullptr; }
  const System& system_;
  NewtonMatrix linear_;
  std::vector<int> group_;  ///< (dofs) groups of equal units
  VectorX held_;
  std::string why_not_known_;
};

}  // namespace bielle::mechanism
