#include "mechanism/joints/gears/mesh_function.hpp"

#include <cmath>
#include <type_traits>

#include "reduce/common/formula/formula_tree.hpp"

namespace bielle::mechanism {
namespace {

/// Returns a formula of two measures. The mixed second derivative follows from that along both together, f_aa + 2 f_ab
/// + f_bb.
template <class Measure>
Measure composed(const Expression& formula, const Measure& a, const Measure& b) {
  const std::array<double, 2> values{a.value, b.value};
  std::array<double, 2> slopes{};
  const double f = formula.value_and_gradient(values, slopes);
  if constexpr (std::is_same_v<Measure, MeshSlope>) {
    return compose(a, b, f, slopes[0], slopes[1]);
  } else {
    const double f_aa = formula.derivative(values, 0, 2), f_bb = formula.derivative(values, 1, 2),
                 along_both = formula_number::second(formula.tree().jet(values, 0, 2));
    return compose(a, b, f, slopes[0], slopes[1], f_aa, 0.5 * (along_both - f_aa - f_bb), f_bb);
  }
}

}  // namespace

Interpolation::Values MeshFunction::Term::at(double angle) const {
  if (!curve) return {formula(angle), formula.derivative(angle, 1), formula.derivative(angle, 2)};
  const double per_radian = teeth / (2 * M_PI);
  Interpolation::Values f = (*curve)(per_radian * angle + phase);
  f.slope *= per_radian;
  f.curvature *= per_radian * per_radian;
  return f;
}

template <int order>
MeshMeasureOf<order> MeshFunction::calc(const ToothContact& contact, const LocalState& state) const {
  MeshMeasureOf<order> sum(constant_);
  for (const Term& term : terms_) {
    const auto angle = contact.turned<order>(term.wheel, state);
    const Interpolation::Values f = term.at(angle.value);
    sum += compose(angle, f.value, f.slope, f.curvature);
  }
  if (of_both_.empty()) return sum;
  const auto first = contact.turned<order>(0, state), second = contact.turned<order>(1, state);
  for (const Expression& formula : of_both_) sum += composed(formula, first, second);
  return sum;
}

template MeshSlope MeshFunction::calc(const ToothContact&, const LocalState&) const;
template MeshMeasure MeshFunction::calc(const ToothContact&, const LocalState&) const;

double MeshFunction::value(const std::array<double, 2>& angle) const {
  double sum = constant_;
  for (const Term& term : terms_) sum += term.at(angle[static_cast<std::size_t>(term.wheel)]).value;
  for (const Expression& formula : of_both_) sum += formula(angle);
  return sum;
}

}  // namespace bielle::mechanism
