// Whether an equilibrium is stable: the inertia of its stiffness along the motions that the constraints allow.
//
// The number of negative eigenvalues of K on the null space of B is read off the pivots of a symmetric factorisation
// (math/negative_directions.hpp); sizes of unknowns are those of their own stiffness, so that no unit decides.
//
// Where the tangent is not symmetric (forces that follow, moments about fixed axes, friction), or forces depend on
// first-order unknowns (controllers, hydraulics), stability is a question of motion, and nothing is counted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "mechanism/solvers/newton/linear_step.hpp"

namespace bielle::mechanism {

class Stability {
 public:
  /// @param held  stiffness (dofs) that holds what is loose, see StaticTangent; null: nothing is
  explicit Stability(const System& system, const VectorX* held = nullptr);

  /// The same from now on.
  void hold(const VectorX& held) { held_ = held; }

  /// How many independent small motions meet a negative stiffness at a state at rest; none where that is not known.
  /// @param environment  in which it is in equilibrium
  std::optional<int> count(const State& state, const Environment& environment);

  /// The motion of the smallest stiffness, whatever its sign.
  struct Mode {
    VectorX shape;         ///< (dofs), the largest displacement relative to the mechanism's size, or turn, is 1
    VectorX force;         ///< (dofs), of unit stiffness along the shape: K shape = stiffness force
    double stiffness = 0;  ///< its sign says whether the equilibrium is stable along it
    int largest = -1;      ///< the unknown that moves most
  };
  /// By inverse iteration. @returns none where the tangent is singular
  std::optional<Mode> softest(const State& state, const Environment& environment);
  /// "z at node 'tip'"
  std::string describe(const Mode& mode) const;

 private:
  struct Parts {
    Eigen::SparseMatrix<double> K;               ///< (dofs, dofs)
    Eigen::SparseMatrix<double> B, B_of_forces;  ///< (constraints, dofs): of constraints, and of how reactions act
  };
  std::optional<Parts> parts() const;
  bool is_symmetric(const Parts& parts, const VectorX& sizes, const VectorX& left_over) const;
  const VectorX* held() const { return held_.size() > 0 ? &held_ : nullptr; }
  const System& system_;
  LinearStep linear_;
  std::vector<int> group_;  ///< (dofs) of one unit
  VectorX held_;
};

}  // namespace bielle::mechanism
