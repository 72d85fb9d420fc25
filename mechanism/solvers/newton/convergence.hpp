// When a Newton iteration is good enough: per kind of equation, or each equation separately; independent of units.
//
// An equation of forces is satisfied when its residual is small relative to the largest contribution of any component
// to the equations of its kind, or has reached what rounding of the unknowns makes of it (sum_j |J_ij| s_j eps). A
// constraint is satisfied when it would change the forces by no more than that: |Phi| k <= tolerance * forces, k the
// tangent's size. Where all that acts comes from one component (a body in free flight, whose inertia and weight are one
// contribution), nothing is left to compare with in the end: there rounding decides.
//
// An amplitude's force is comparable with the forces on nodes by the energy that a residual r is worth, r^2 / (2 J_ii):
// modes that nothing excites carry rounding of those forces, and are not judged by it. The softest amplitude and the
// stiffest node give the least force that counts.
//
// The equation of an amplitude or first-order unknown u that has a scale s is judged by nothing but itself, however
// large other unknowns of its kind are. Its residual is compared with the largest of its own terms,
//     k max(|u|, s),   m |u'|   and   j s/n,
// j the diagonal of the tangent, m its part by the highest rate u' (d2u/dt2 of an amplitude, du/dt else), and k the
// rest: what it takes to hold u at its size, what it takes to change it as fast as it does, and, where both vanish,
// what it takes to go over its scale within a thousand steps (n = 10^3, or 10^6 of an amplitude). Where the equation
// does not hold u at all (j = 0), what the scales of all unknowns make of it counts: sum_j |J_ij| s_j.
#pragma once

#include <array>
#include <vector>

#include "mechanism/solvers/newton/linear_step.hpp"

namespace bielle::mechanism {

struct NewtonOptions {
  double tolerance = 1e-9;  ///< relative, see the head of this file
  int iterations = 20;      ///< at most
  /// Where a full step makes the residual larger, half of it, a quarter or an eighth is tried.
  bool line_search = true;
  /// Factors of the tangent serve as long as the residual falls fast enough with them; otherwise they are renewed at
  /// each iteration. Time integration only.
  bool reuse_tangent = true;
  /// Highest order of the extrapolation that a step starts from; 0: from unchanged accelerations and multipliers. Time
  /// integration only, which takes no order above 4.
  int extrapolation = 4;
};

class Convergence {
 public:
  Convergence(const System& system, const NewtonOptions& options);

  /// Renews the rounding floor from the last tangent, and the terms of equations that are judged by themselves.
  void measure_rounding(const LinearStep& linear, const State& state);
  /// Those terms alone: cheap.
  void measure_terms(const LinearStep& linear, const State& state);
  /// @param r  residual (size) with its scale
  bool reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale);
  /// Whether a residual of the given size (by `size_of`) is certain not to be small enough at this scale: to be asked
  /// first, it costs nothing.
  bool out_of_reach(double size, const ResidualScale& scale) const;
  /// Fixes what `size_of` measures by: the tolerances at this residual's scale.
  void measure_by(const ResidualScale& scale);
  /// Largest residual over the tolerances that `measure_by` fixed: comparable from iterate to iterate, whatever forces
  /// a wild one has. Infinite for what is no number.
  double size_of(const Eigen::Ref<const VectorX>& r) const;
  /// The equation that was farthest from its tolerance in the last call of `reached`: "moment z at node 'pin' (3.2e+04
  /// N m)".
  std::string worst() const;
  int worst_equation() const { return worst_; }  ///< -1: all residuals vanish
  double worst_residual() const { return worst_residual_; }
  double worst_ratio() const { return worst_ratio_; }  ///< residual over tolerance

 private:
  static constexpr int by_itself = static_cast<int>(kind_count);
  /// Of the residuals of each kind, rounding left out; none of those that are judged by themselves.
  using Tolerances = std::array<double, kind_count + 1>;
  Tolerances tolerances(const ResidualScale& scale) const;
  void measure_amplitudes(const LinearStep& linear);
  void measure_highest_rates(const LinearStep& linear, const State& state);

  /// An equation that is judged separately.
  struct Own {
    int equation;
    double scale;
    double rate = 0;      ///< m: the tangent's part by the highest rate, without the weight that the step gives it
    double rounding = 0;  ///< of its residual
  };

  const System& system_;
  NewtonOptions options_;
  std::vector<int> judged_by_;  ///< of each equation: its kind, or `by_itself`
  std::vector<Own> own_;
  VectorX floor_;  ///< rounding of each equation; of those judged by themselves with their tolerances
  VectorX unknown_scale_, measure_;
  std::vector<double> highest_rates_;  ///< values of a tangent
  Tolerances measured_by_{};           ///< tolerances in `measure_`, rounding left out
  bool measured_ = false;              ///< `measure_` is of the present rounding floor
  double scale_ = 1;
  /// By kind of node equations: a force on amplitudes that is worth as much energy as a unit of it.
  std::array<double, kind_count> amplitude_per_force_{};
  int worst_ = -1;
  double worst_residual_ = 0, worst_ratio_ = 0;
};

}  // namespace bielle::mechanism
