// Unknowns of a search for equilibrium in addition to those of the system, with equal number of equations.
//
// Newton's method eliminates them with the tangent's factors.
#pragma once

#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

class Bordering {
 public:
  virtual ~Bordering() = default;
  virtual void begin() {}  ///< begins a search
  /// Adds forces of these unknowns to a residual (size), and stores the residual of their equations at the state.
  virtual void add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r) = 0;
  /// Returns whether their equations are satisfied, to rounding. @param scale  scale of the residual
  virtual bool reached(const ResidualScale& scale) = 0;
  /// Computes delta with the tangent's factors for a residual r that includes the forces; the change of these unknowns
  /// is stored for `move`.
  virtual void solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) = 0;
  /// Moves the unknowns by a fraction of the change, from their values in the last solution.
  virtual void move(State& state, double part) = 0;
  /// Solves as if their equations were satisfied: for a motion along which nothing is held.
  virtual void solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                           Eigen::Ref<VectorX> delta) const = 0;

 protected:
  Bordering() = default;
  Bordering(const Bordering&) = default;
  Bordering& operator=(const Bordering&) = default;
};

}  // namespace bielle::mechanism
