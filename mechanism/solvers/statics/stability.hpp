// Whether an equilibrium is stable: the inertia of its stiffness along the motions that the constraints allow.
//
// The number of negative eigenvalues of K on the null space of B is that of
//     [ K    B^T S ]
//     [ S B  -eps  ]
// less one for each constraint (Sylvester; the Schur complement of the lower block is K + B^T S^2 B/eps), S^2 diagonal
// with the stiffness that each constraint meets: constraints give by eps = 1e-4 of what is next to them, which soft
// motions do not notice. It is read off the pivots of a symmetric factorisation. The sign of a determinant would miss
// two eigenvalues that change sign together, as of a square column.
//
// Where the tangent is not symmetric (forces that follow, moments about fixed axes, friction), or forces depend on
// first-order unknowns (controllers, hydraulics), stability is a question of motion, and nothing is counted.
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/newton/linear_step.hpp"

namespace bielle::mechanism {

class Stability {
 public:
  /// @param held  stiffness (dofs) that holds what is loose, see StaticTangent; null: nothing is
  explicit Stability(const System& system, const VectorX* held = nullptr)
      : system_(system), linear_(system), held_(held ? *held : VectorX()) {}

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
  VectorX row_scales() const;  ///< S, of all rows
  const VectorX* held() const { return held_.size() > 0 ? &held_ : nullptr; }
  const System& system_;
  LinearStep linear_;
  VectorX held_;
};

}  // namespace bielle::mechanism
