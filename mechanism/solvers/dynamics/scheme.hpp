// Constants of the one-step schemes for second-order equations, all members of one family:
//
//   (1 - alpha_m) A_{n+1} + alpha_m A_n = (1 - alpha_f) a_{n+1} + alpha_f a_n
//   q_{n+1} = q_n + h v_n + h^2 ((1/2 - beta) A_n + beta A_{n+1})
//   v_{n+1} = v_n + h ((1 - gamma) A_n + gamma A_{n+1})
//
// J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371; H. M. Hilber, T. J. R. Hughes, R. L. Taylor, Earthq. Eng.
// Struct. Dyn. 5 (1977) 283; M. Arnold, O. Bruls, Multibody Syst. Dyn. 18 (2007) 185 (this form, with A next to
// the true a).
#pragma once

namespace bielle::mechanism {

struct Scheme {
  double alpha_m, alpha_f, gamma, beta;

  /// @param rho  spectral radius at infinite frequency, in [0, 1]: 0 annihilates high frequencies, 1 preserves them.
  ///             @throws InputError
  static Scheme generalized_alpha(double rho);
  /// @param alpha  in [0, 1/3]: 0 is Newmark's trapezoidal rule. @throws InputError
  static Scheme hht(double alpha);
  /// gamma = 1/2, beta = 1/4: weakly unstable with constraints at every step size
  static Scheme newmark();

  double delta() const { return alpha_m - alpha_f; }  ///< A_n = a(t_n + delta h) + O(h^2)
  /// Coefficient of the local error of q: C_q h^3 da/dt = C_q h^2 (A_{n+1} - A_n), exact minus computed.
  double position_error() const { return -(1 + 3 * delta() * delta()) / 12; }
  /// Largest rotation per step of the direction of a constraint of index 3 for which errors of its multiplier decay
  /// (for the pendulum with a point mass, the worst case; measured as 0.154 with rho = 0.8) [rad]
  double most_turn() const;
  /// Coefficient of the local error of v (and of first-order unknowns): C_v h^3 d2a/dt2, exact minus computed.
  double velocity_error() const { return 1.0 / 6 - delta() * (alpha_m - 0.5) - gamma * (0.5 + delta()); }
};

}  // namespace bielle::mechanism
