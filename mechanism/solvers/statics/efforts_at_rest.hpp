// Sought efforts (solvers/constraints/sought_efforts.hpp) in equilibrium at rest: additional unknowns of Newton's
// method, with the forces of the supports as equations.
#pragma once

#include <limits>

#include "mechanism/solvers/constraints/sought_efforts.hpp"
#include "mechanism/solvers/statics/bordering.hpp"

namespace bielle::mechanism {

class EffortsAtRest final : public Bordering {
 public:
  /// The object keeps a reference.
  explicit EffortsAtRest(const SoughtEfforts& efforts) : efforts_(efforts) {}

  /// Sets reactions (6, nodes) that are added to those at rest until the next call, or none (size 0).
  void push(const MatrixX& reactions) { push_ = reactions; }
  void begin() override { before_ = std::numeric_limits<double>::infinity(); }
  void add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r) override;
  bool reached(const ResidualScale& scale) override;
  void solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) override;
  void move(State& state, double part) override;
  void solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                   Eigen::Ref<VectorX> delta) const override;

  /// Computes the response of the supports to the efforts at a state, with the tangent's factors.
  static EffortResponse response(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                                 const StaticTangent& tangent);
  /// Computes the derivative of the supports' forces (count) along a step of the unknowns (size), by a difference.
  static VectorX answer(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                        const VectorX& step);

 private:
  VectorX rounding_floor() const;
  const SoughtEfforts& efforts_;
  MatrixX push_;
  Environment environment_;
  State state_;  ///< state of the last residual
  VectorX gap_, base_, change_;
  VectorX floor_;  ///< effect of rounding of positions on the gap
  EffortResponse response_;
  double before_ = 0;  ///< size of the gap when it was last evaluated
};

}  // namespace bielle::mechanism
