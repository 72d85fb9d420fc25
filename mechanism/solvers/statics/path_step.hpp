// One step along a path of equilibria: Newton's method for r(q, s) = 0 together with a condition on (q, s).
#pragma once

#include <string>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

/// A trial point relative to a base: state = base o delta at a load factor.
struct PathTrial {
  VectorX delta;  ///< (size): increments on the group, of first-order unknowns and multipliers
  double factor = 0;
  State state;
  int iterations = 0;
};

/// A scalar equation g(trial) = 0.
class PathCondition {
 public:
  virtual ~PathCondition() = default;
  virtual double value(const PathTrial& trial) const = 0;
  /// Derivative along a direction of increments (size) and of the load factor.
  virtual double slope(const PathTrial& trial, const VectorX& along, double factor) const = 0;
  virtual double tolerance() const = 0;
};

class PathStep {
 public:
  /// @param state  in equilibrium under the ramp's first load factor: sizes of the measure are computed from it
  PathStep(const LoadRamp& ramp, const NewtonOptions& options, const State& state);

  /// a . W b over the dofs, see arc_length.hpp. The length of a uniform displacement is relative to the mechanism's
  /// extent.
  double product(const VectorX& a, const VectorX& b) const;
  double length(const VectorX& a) const { return std::sqrt(product(a, a)); }
  double extent() const { return extent_; }  ///< [m]
  const VectorX* held() const { return tangent_.held(); }
  bool runs_loose(const VectorX& delta) const { return tangent_.runs_loose(delta); }  ///< see StaticTangent

  /// Sets trial.state from its increments and its load factor.
  void place(const State& base, PathTrial& trial) const;
  /// Computes b = -K^-1 dr/ds: the derivative of the state by the load factor. @returns false if the tangent is
  /// singular
  bool response(const State& state, double factor, VectorX& b);
  /// Newton's method from the trial's increments and load factor. @returns whether it found a point; otherwise `why`
  /// gives the reason
  /// @param longest  largest length of the increments: a longer one means divergence
  bool correct(const State& base, const PathCondition& condition, double longest, PathTrial& trial);
  const std::string& why() const { return why_; }
  std::string worst() const { return convergence_.worst(); }  ///< residual of the last iteration

 private:
  bool iterate(const State& base, const PathCondition& condition, double longest, PathTrial& trial);

  const LoadRamp& ramp_;
  const System& system_;
  NewtonOptions options_;
  StaticTangent tangent_;
  Convergence convergence_;
  ReadReactions reactions_;
  VectorX weights_;  ///< W (dofs), diagonal
  double extent_;
  std::string why_;
};

/// The condition |delta|_W = arc.
class ArcCondition final : public PathCondition {
 public:
  ArcCondition(const PathStep& step, double arc) : step_(step), area_(arc * arc) {}
  double value(const PathTrial& trial) const override { return step_.product(trial.delta, trial.delta) / area_ - 1; }
  double slope(const PathTrial& trial, const VectorX& along, double) const override {
    return 2 * step_.product(trial.delta, along) / area_;
  }
  double tolerance() const override { return 1e-9; }

 private:
  const PathStep& step_;
  double area_;
};

}  // namespace bielle::mechanism
