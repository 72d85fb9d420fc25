#include "mechanism/solvers/linearised/mode_judgement.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/equation_products.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;

/// Returns y^T a, without conjugation.
Complex paired(const VectorXc& y, const VectorXc& a) { return (y.transpose() * a)(0); }

}  // namespace

/// Returns the left vector. For general equations it is computed only for modes that grow by more than the drift
/// allows, since it costs a factorisation.
VectorXc ModeJudgement::left(const Mode& mode) const {
  constexpr double nearly = 1e-3;
  if (symmetry_ == EquationSymmetry::symmetric) return mode.u;
  if (symmetry_ == EquationSymmetry::gyroscopic && std::abs(mode.s.real()) <= nearly * std::abs(mode.s))
    return mode.u.conjugate();
  if (mode.s.real() <= drift_uncertainty(mode.s)) return {};
  return left_vector(e_, mode.s, mode.u);
}

/// Returns the uncertainty of s due to the change of the equations. The operator (A - sigma E)^-1 E, where sigma is the
/// rate, changes by this fraction, and so does s - sigma. Such a change splits double zeros; the square of their s
/// changes by this fraction of the square of the rate.
double ModeJudgement::drift_uncertainty(Complex s) const {
  const double size = std::abs(s), split = rate_ * std::sqrt(drift_);
  return std::max(drift_ * (rate_ + size), size < split ? split : 0.0);
}

void ModeJudgement::judge(Mode& mode) const {
  const int n = e_.unknowns();
  VectorXc y = left(mode), u = VectorXc::Zero(n + e_.constraints());
  u.head(n) = mode.u;
  mode.uncertainty = 0;
  if (y.size() > 0) {
    y.conservativeResizeLike(VectorXc::Zero(n + e_.constraints()));
    const Complex slope = paired(y, equations_derivative_times(e_, mode.s, u)),
                  bend = paired(y.head(n), e_.M.cast<Complex>() * mode.u);
    const double delta = rounding_(y.head(n), mode.s, mode.u);
    mode.uncertainty = std::min(delta / std::abs(slope), std::sqrt(delta / std::abs(bend)));
    if (!std::isfinite(mode.uncertainty)) mode.uncertainty = delta > 0 ? std::abs(mode.s) : 0;
    const Complex change = paired(y, equations_times(e_, mode.s, u)) / slope;
    constexpr double near = 1e-3;
    if (std::abs(change) > mode.uncertainty && std::abs(change) < near * std::abs(mode.s)) {
      const bool real = mode.s.imag() == 0;
      mode.s -= change;
      if (real) mode.s = mode.s.real();
    }
  }
  mode.uncertainty += drift_uncertainty(mode.s);
  if (mode.s.real() > mode.uncertainty)
    mode.kind = ModeKind::growing;
  else
    mode.kind = mode.s.imag() == 0 ? ModeKind::decaying : ModeKind::oscillating;
}

bool ModeJudgement::is_nothing(Complex s, const VectorXc& u) const {
  // The size of each term is taken separately, because the terms of a motion that a damper decelerates cancel.
  const Complex damping =
                    s * u.dot(VectorXc(e_.C.cast<Complex>() * u + e_.M.cast<Complex>() * (e_.W.cast<Complex>() * u))),
                inertia = s * s * u.dot(e_.M.cast<Complex>() * u);
  return std::abs(damping) + std::abs(inertia) <= rounding_(u.conjugate(), 0, u);
}

}  // namespace bielle::mechanism
