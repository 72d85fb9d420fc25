#include "mechanism/solvers/dynamics/error_norm.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
ErrorNorm::ErrorNorm(const System& system, const Environment& environment, const State& state)
    : system_(system),
      length_(model_extent(state)),
      largest_first_order_(state.first_order.cwiseAbs()),
      algebraic_(static_cast<std::size_t>(system.first_orders()), false) {
  for (const int k : system.algebraic()) algebraic_[static_cast<std::size_t>(k)] = true;
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{0, 0, 1, 0, 0}, nullptr, values);
  mass_.setZero(system.dofs());
  for (int i = 0; i < system.dofs(); ++i) {
    const int place = system.pattern().find(i, i);
    if (place >= 0) mass_[i] = std::abs(values[static_cast<std::size_t>(place)]);
    if (system.kind(i) == Kind::translation) mass_sum_ += mass_[i] / 3;
    if (system.kind(i) == Kind::rotation) inertia_sum_ += mass_[i] / 3;
  }
}

void ErrorNorm::exchange(Archive& archive) {
  archive(mass_);
  archive(mass_sum_);
  archive(inertia_sum_);
  archive(length_);
  archive(largest_first_order_);
}

/// @param e  error of the dofs
double ErrorNorm::of_positions(const VectorX& e) const {
  double displacement = 0, rotation = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    (system_.kind(i) == Kind::rotation ? rotation : displacement) += mass_[i] * e[i] * e[i];
  double error = 0;
  if (mass_sum_ > 0) error = std::max(error, std::sqrt(displacement / mass_sum_) / length_);
  if (inertia_sum_ > 0) error = std::max(error, std::sqrt(rotation / inertia_sum_));
  return error;
}

double ErrorNorm::of_impulse(const VectorX& impulse, double h) const {
  VectorX e = VectorX::Zero(system_.dofs());
  for (int i = 0; i < system_.dofs(); ++i)
    if (mass_[i] > 0) e[i] = h * impulse[i] / mass_[i];
  double error = of_positions(e);
  for (int k = 0; k < system_.first_orders(); ++k) {
    const double size = std::max(system_.scale(system_.dofs() + k), largest_first_order_[k]);
    if (size > 0 && !algebraic_[static_cast<std::size_t>(k)])
      error = std::max(error, std::abs(impulse[system_.dofs() + k]) / size);
  }
  return error;
}

double ErrorNorm::operator()(const TimeIntegration& integration) {
  double error = of_positions(integration.position_error());
  const VectorX e_y = integration.first_order_error();
  largest_first_order_ = largest_first_order_.cwiseMax(integration.state().first_order.cwiseAbs());
  for (int i = 0; i < system_.first_orders(); ++i) {
    if (algebraic_[static_cast<std::size_t>(i)]) continue;
    const double scale = system_.scale(system_.dofs() + i);
    const double size =
        scale > 0 ? std::max(scale, std::abs(integration.state().first_order[i])) : largest_first_order_[i];
    if (size > 0) error = std::max(error, std::abs(e_y[i]) / size);
  }
  return error;
}

}  // namespace bielle::mechanism
