// The energy that the damping of the scheme itself takes out of a motion, step by step.
//
// With  e = A - a,  [e] its mean over a step and D( ) the change over it, the relations of the scheme (scheme.hpp) and
// gamma = 1/2 + alpha_f - alpha_m, beta = (gamma + 1/2)^2/4, as all its members have them, give for M a = -K q +
// constant, without any approximation and whatever the step,
//
//   D(E + L) = -h^2 (1 - alpha_m - alpha_f)^2 / (4 (alpha_f - alpha_m)) [e].M [e]  <= 0.
//
// What stands on the right is the scheme's dissipation: of the order h^3 of the motion per unit of time, nothing for
// rho = 1 and for Newmark (where e fades), and most of the energy of what the steps do not resolve. L, of order h^2, is
// lent and comes back:
//   with g = alpha_f - alpha_m, b = beta - gamma/2, p = 1/2 - alpha_m, r = 1/2 - alpha_f,
//   L = r (h v.M e + h^2 g a.M a/2 + h^2 p a.M e) + h^2 b A.M A/2 + h^2 l e.M e/2,
//   l = (2 p (r p + b) - r (p^2 - g p + g^2 + b) - 2 b g)/g.
// In motions that turn, and with other forces, what the balance of energy lacks besides is error of the steps.
//
// It takes the matrix M: in each of the first steps, then in one of eight, which are chosen irregularly, so that no
// oscillation is met at the same phase each time, and count eight times.
//
// S. Erlicher, L. Bonaventura, O. S. Bursi, Comput. Mech. 28 (2002) 83, on the energy of the generalised-alpha method.
#pragma once

#include "mechanism/model/archive.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

class SchemeLoss {
 public:
  /// Whether a scheme takes energy out of linear oscillations.
  static bool is_of(const Scheme& scheme) { return scheme.alpha_f - scheme.alpha_m > 1e-12; }
  /// Adds what is lost in a trial that is accepted; comes before `take_algorithmic_values`.
  void add(const SchemeStep& step, const Environment& environment);
  double total() const { return total_; }  ///< since the start [J], >= 0
  void exchange(Archive& archive);

 private:
  double calc(const SchemeStep& step, const Environment& environment);
  double total_ = 0;
  long steps_ = 0;
  std::vector<double> mass_;  ///< a buffer: values of the tangent
};

}  // namespace bielle::mechanism
