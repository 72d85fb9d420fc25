// The energy that the numerical damping of the scheme removes from a motion, step by step.
//
// With  e = A - a,  its mean [e] over a step and the change D( ) over it, the relations of the scheme (scheme.hpp) and
// gamma = 1/2 + alpha_f - alpha_m, beta = (gamma + 1/2)^2/4, which all its members satisfy, give for M a = -K q +
// constant, without any approximation and for any step,
//
//   D(E + L) = -h^2 (1 - alpha_m - alpha_f)^2 / (4 (alpha_f - alpha_m)) [e].M [e]  <= 0.
//
// The right-hand side is the scheme's dissipation. It has the order h^3 of the motion per unit of time, is zero for rho
// = 1 and for Newmark (for which e decays), and removes most of the energy of motions that the steps do not resolve. L,
// of order h^2, is stored and returned:
//   with g = alpha_f - alpha_m, b = beta - gamma/2, p = 1/2 - alpha_m, r = 1/2 - alpha_f,
//   L = r (h v.M e + h^2 g a.M a/2 + h^2 p a.M e) + h^2 b A.M A/2 + h^2 l e.M e/2,
//   l = (2 p (r p + b) - r (p^2 - g p + g^2 + b) - 2 b g)/g.
// In motions with rotation, and with other forces, the remaining error of the energy balance is an error of the steps.
//
// The computation needs the matrix M: in each of the first steps, then in one of eight, which are chosen irregularly,
// so that no oscillation is always sampled at the same phase, and have the weight eight.
//
// S. Erlicher, L. Bonaventura, O. S. Bursi, Comput. Mech. 28 (2002) 83, on the energy of the generalised-alpha method.
#pragma once

#include "mechanism/model/archive.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

class SchemeLoss {
 public:
  /// Returns whether a scheme removes energy from linear oscillations.
  static bool is_of(const Scheme& scheme) { return scheme.alpha_f - scheme.alpha_m > 1e-12; }
  /// Adds the loss of a trial that is accepted; call it before `take_algorithmic_values`.
  void add(const SchemeStep& step, const Environment& environment);
  double total() const { return total_; }  ///< loss since the start [J], >= 0
  void exchange(Archive& archive);

 private:
  double calc(const SchemeStep& step, const Environment& environment);
  double total_ = 0;
  long steps_ = 0;
  std::vector<double> mass_;  ///< a buffer: values of the tangent
};

}  // namespace bielle::mechanism
