// Convergence criteria of Newton iterations: per kind of equation, or for each equation separately; independent of
// units.
//
// An equation of forces is satisfied if its residual is small relative to the largest contribution of any component to
// the equations of its kind, or is below the effect of rounding of the unknowns (sum_j |J_ij| s_j eps). A constraint is
// satisfied if it would change the forces by no more than that: |Phi| k <= tolerance * forces, with the tangent's size
// k. If all forces come from one component (a body in free flight, whose inertia and weight are one contribution),
// finally there is no reference left: then the rounding limit decides.
//
// An amplitude's force is compared with the forces on nodes by the energy of a residual r, r^2 / (2 J_ii): modes that
// are not excited have rounding errors of those forces, and must not be judged by these. The softest amplitude and the
// stiffest node give the smallest force that is significant.
//
// The equation of an amplitude or first-order unknown u that has a scale s is judged by its own terms only, however
// large other unknowns of its kind are. Its residual is compared with the largest of these terms,
//     k max(|u|, s),   m |u'|   and   j s/n,
// Here j is the diagonal of the tangent, m its part due to the highest rate u' (d2u/dt2 of an amplitude, du/dt
// otherwise), and k the rest. The terms are the force at the size of u, the force at its present rate, and, if both are
// zero, the force that changes u by its scale within a thousand steps (n = 10^3, or 10^6 for an amplitude). If the
// equation does not contain u (j = 0), the effect of the scales of all unknowns is used: sum_j |J_ij| s_j.
#pragma once

#include <array>
#include <vector>

#include "mechanism/solvers/newton/newton_matrix.hpp"

namespace bielle::mechanism {

/// Lifetime of the factors of the tangent.
enum class Tangent {
  automatic,  ///< they are reused while this costs less, by counts of the model's operations, than renewing them
  reused,     ///< they are reused as long as the residual decreases fast enough with them
  renewed     ///< they are computed at each iteration
};

struct NewtonOptions {
  double tolerance = 1e-9;  ///< relative tolerance, see the head of this file
  int iterations = 20;      ///< largest number of iterations
  /// If a full step increases the residual, one half, a quarter and an eighth of it are tried.
  bool line_search = true;
  Tangent tangent = Tangent::automatic;  ///< only time integration uses this option
  /// Highest order of the extrapolation for the initial guess of a step; 0: unchanged accelerations and multipliers.
  /// Only time integration uses this option, up to order 4.
  int extrapolation = 4;
};

class Convergence {
 public:
  Convergence(const System& system, const NewtonOptions& options);

  /// Computes the rounding limits from the last tangent, and the terms of equations that are judged separately.
  void measure_rounding(const NewtonMatrix& linear, const State& state);
  /// Computes only these terms, at low cost.
  void measure_terms(const NewtonMatrix& linear, const State& state);
  /// @param r  residual (size) with its scale
  bool reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale);
  /// Returns whether a residual of the given size (by `size_of`) certainly exceeds the tolerance at this scale: a check
  /// at no cost.
  bool out_of_reach(double size, const ResidualScale& scale) const;
  /// Sets the tolerances used by `size_of` to those at this residual's scale.
  void measure_by(const ResidualScale& scale);
  /// Returns the largest residual relative to the tolerances of `measure_by`: it is comparable between iterates, even
  /// if a distant one has large forces. It is infinite if a residual is not a number.
  double size_of(const Eigen::Ref<const VectorX>& r) const;
  /// Describes the equation with the largest ratio to its tolerance in the last call of `reached`: "moment z at node
  /// 'pin' (3.2e+04 N m)".
  std::string worst() const;
  int worst_equation() const { return worst_; }  ///< -1: all residuals are zero
  double worst_residual() const { return worst_residual_; }
  double worst_ratio() const { return worst_ratio_; }  ///< residual over tolerance

 private:
  static constexpr int by_itself = static_cast<int>(kind_count);
  /// Tolerances of each kind, without rounding; zero for equations that are judged separately.
  using Tolerances = std::array<double, kind_count + 1>;
  Tolerances tolerances(const ResidualScale& scale) const;
  void measure_amplitudes(const NewtonMatrix& linear);
  void measure_highest_rates(const NewtonMatrix& linear, const State& state);

  /// An equation that is judged separately.
  struct Own {
    int equation;
    double scale;
    double rate = 0;      ///< m: the tangent's part due to the highest rate, without the weight of the step
    double rounding = 0;  ///< rounding of its residual
  };

  const System& system_;
  NewtonOptions options_;
  std::vector<int> judged_by_;  ///< for each equation: its kind, or `by_itself`
  std::vector<Own> own_;
  VectorX floor_;  ///< rounding of each equation; for those judged separately, including their tolerances
  VectorX unknown_scale_, measure_;
  std::vector<double> highest_rates_;  ///< values of a tangent
  Tolerances measured_by_{};           ///< tolerances in `measure_`, without rounding
  bool measured_ = false;              ///< whether `measure_` uses the present rounding limits
  double scale_ = 1;
  /// For each kind of node equations: the force on amplitudes with the same energy as a unit force of this kind.
  std::array<double, kind_count> amplitude_per_force_{};
  int worst_ = -1;
  double worst_residual_ = 0, worst_ratio_ = 0;
};

}  // namespace bielle::mechanism
