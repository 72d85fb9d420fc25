#include "mechanism/joints/gears/mesh_function.hpp"

#include <cmath>

namespace bielle::mechanism {

Interpolation::Values MeshFunction::Term::at(double angle) const {
  if (!curve) return {formula(angle), formula.derivative(angle, 1), formula.derivative(angle, 2)};
  const double per_radian = teeth / (2 * M_PI);
  Interpolation::Values f = (*curve)(per_radian * angle + phase);
  f.slope *= per_radian;
  f.curvature *= per_radian * per_radian;
  return f;
}

MeshMeasure MeshFunction::operator()(const ToothContact& contact, const LocalState& state) const {
  MeshMeasure sum(constant_);
  for (const Term& term : terms_) {
    const MeshMeasure angle = contact.turned(term.wheel, state);
    const Interpolation::Values f = term.at(angle.value);
    sum += compose(angle, f.value, f.slope, f.curvature);
  }
  return sum;
}

double MeshFunction::value(const std::array<double, 2>& angle) const {
  double sum = constant_;
  for (const Term& term : terms_) sum += term.at(angle[static_cast<std::size_t>(term.wheel)]).value;
  return sum;
}

}  // namespace bielle::mechanism
