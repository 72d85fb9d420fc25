// Unknowns of a search for equilibrium besides those of the system, with as many equations of their own.
//
// Newton's method eliminates them with the tangent's factors.
#pragma once

#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

class Bordering {
 public:
  virtual ~Bordering() = default;
  virtual void begin() {}  ///< a search begins
  /// Adds forces of these unknowns to a residual (size), and notes what is left of their equations at the state.
  virtual void add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r) = 0;
  /// Whether their equations hold, to rounding. @param scale  of the residual
  virtual bool reached(const ResidualScale& scale) = 0;
  /// delta of the tangent's factors for a residual r with the forces in it; the change of these unknowns is kept for
  /// `move`.
  virtual void solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) = 0;
  /// Moves them by a part of the change, from where they were in the last solution.
  virtual void move(State& state, double part) = 0;
  /// Takes their equations for satisfied in the next solution: a motion along which nothing is held.
  virtual void solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                           Eigen::Ref<VectorX> delta) const = 0;

 protected:
  Bordering() = default;
  Bordering(const Bordering&) = default;
  Bordering& operator=(const Bordering&) = default;
};

}  // namespace bielle::mechanism
