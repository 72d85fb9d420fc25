// Generalised-alpha on the configuration group, index-3 form: one step as a page of verbs.
//
//   Dq       = h v_n + h^2 (1/2 - beta) A_n + h^2 beta A_{n+1},      q_{n+1} = q_n o exp(Dq)
//   v_{n+1}  = v_n + h (1 - gamma) A_n + h gamma A_{n+1}
//   (1 - alpha_m) A_{n+1} + alpha_m A_n = (1 - alpha_f) a_{n+1} + alpha_f a_n
//   r(q, v, a, lambda, t)_{n+1} = 0,  Phi(q, t)_{n+1} = 0
// solved for Dq and lambda_{n+1} with the matrix K T(Dq) + gamma' C + beta' M, gamma' = gamma/(beta h),
// beta' = (1 - alpha_m)/((1 - alpha_f) beta h^2). First-order unknowns use the velocity formula with their own rates.
//
// Second order in positions and velocities; in multipliers and accelerations from the first step only with the start
// values
//   A_0 = a_0 + delta h j,   v_0 <- v_0 + h^2 w,   [M B^T; B 0][w; mu] = [0; B c],   c = C_q j + [0; Omega x
//   Omegadot]/12,
// delta = alpha_m - alpha_f, C_q = -(1 + 3 delta^2)/12, j the rate of the consistent acceleration.
//
// O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121; M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129
// (2015) 149 (order of the multipliers).
#pragma once

#include <functional>
#include <string>

#include "mechanism/solvers/consistent_start.hpp"

namespace bielle::mechanism {

/// Constants of a member of the family.
struct Scheme {
  double alpha_m, alpha_f, gamma, beta;

  /// @param rho  spectral radius at infinite frequency, in [0, 1]: 0 annihilates, 1 keeps
  static Scheme generalized_alpha(double rho);
  /// @param alpha  in [0, 1/3]: 0 is Newmark's trapezoidal rule
  static Scheme hht(double alpha);
  /// gamma = 1/2, beta = 1/4: weakly unstable with constraints at every step size
  static Scheme newmark();
  double delta() const { return alpha_m - alpha_f; }
};

/// What a step did.
struct StepReport {
  int iterations = 0;      ///< linear solves of Newton's method
  double worst_ratio = 0;  ///< residual over tolerance at the end
};

class TimeIntegration {
 public:
  /// @param state  positions and velocities to start from; made consistent here
  TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme, State state,
                  const NewtonOptions& options = {});

  /// Sets the algorithmic start values for steps of size h. Call once before the first step.
  void start(double h);
  /// Advances by h. The size may change between steps. @throws ComputationError naming time and equation
  StepReport step(double h);

  const State& state() const { return state_; }
  const StartReport& start_report() const { return start_report_; }

 private:
  VectorX acceleration_rate(double h);              ///< j
  bool resolved(const VectorX& j, double h) const;  ///< accelerations change little within a step
  void perturb_velocity(const VectorX& j, double factor);

  const System& system_;
  Environment environment_;
  Scheme scheme_;
  State state_, next_;
  StartReport start_report_;
  LinearStep linear_;
  NewtonOptions options_;
  Convergence convergence_;
  VectorX v_, a_, A_;  ///< of the dofs at the last accepted time
  VectorX Y_;          ///< algorithmic rates of the first-order unknowns
  VectorX dq_, v_new_, a_new_, A_new_, Y_new_, r_, delta_;
};

}  // namespace bielle::mechanism
