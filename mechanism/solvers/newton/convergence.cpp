#include "mechanism/solvers/newton/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

constexpr double rounding_of_a_sum = 10 * std::numeric_limits<double>::epsilon();  // for about ten terms

}  // namespace

Convergence::Convergence(const System& system, const NewtonOptions& options)
    : system_(system), options_(options), floor_(VectorX::Zero(system.size())) {
  for (int i = 0; i < system.size(); ++i) {
    const Kind kind = system.kind(i);
    const bool own = (kind == Kind::amplitude || kind == Kind::first_order) && system.scale(i) > 0;
    judged_by_.push_back(own ? by_itself : static_cast<int>(kind));
    if (own) own_.push_back({i, system.scale(i)});
  }
}

void Convergence::measure_rounding(const NewtonMatrix& linear, const State& state) {
  const int n = system_.size(), scalars = system_.kinematics().unknowns();
  const double length = model_length(state);
  unknown_scale_.resize(n);
  for (int i = 0; i < scalars; ++i) unknown_scale_[i] = system_.kind(i) == Kind::translation ? length : 1;
  // Scalars without a scale use the largest of their kind.
  int begin = scalars;
  for (const VectorX* values : {&state.amplitude, &state.first_order, &state.multiplier}) {
    double largest = 0;
    for (int k = 0; k < values->size(); ++k)
      if (system_.scale(begin + k) == 0) largest = std::max(largest, std::abs((*values)[k]));
    for (int k = 0; k < values->size(); ++k) {
      const double scale = system_.scale(begin + k);
      unknown_scale_[begin + k] = scale > 0 ? std::max(std::abs((*values)[k]), scale) : largest;
    }
    begin += static_cast<int>(values->size());
  }
  floor_.resize(n);
  linear.row_sums(unknown_scale_, floor_);
  floor_ *= rounding_of_a_sum;
  for (Own& own : own_) own.rounding = floor_[own.equation];
  scale_ = linear.scale();
  measure_amplitudes(linear);
  measure_highest_rates(linear, state);
  measure_terms(linear, state);
  measured_ = false;
}

void Convergence::measure_amplitudes(const NewtonMatrix& linear) {
  const int scalars = system_.kinematics().unknowns(), end = system_.dofs();
  amplitude_per_force_ = {};
  double softest = std::numeric_limits<double>::infinity();
  for (int i = scalars; i < end; ++i)
    if (judged_by_[static_cast<std::size_t>(i)] != by_itself) softest = std::min(softest, std::abs(linear.diagonal(i)));
  if (!std::isfinite(softest)) return;
  std::array<double, kind_count> stiffest{};
  for (int i = 0; i < scalars; ++i) {
    double& largest = stiffest[static_cast<std::size_t>(system_.kind(i))];
    largest = std::max(largest, std::abs(linear.diagonal(i)));
  }
  for (std::size_t k = 0; k < kind_count; ++k)
    if (stiffest[k] > 0) amplitude_per_force_[k] = std::sqrt(softest / stiffest[k]);
}

void Convergence::measure_highest_rates(const NewtonMatrix& linear, const State& state) {
  const TangentWeights& weights = linear.weights();
  if (own_.empty() || (weights.mass == 0 && weights.first_order == 0)) return;
  system_.tangent(state, Environment{}, TangentWeights{0, 0, 1, 1, 0}, nullptr, highest_rates_);
  for (Own& own : own_) {
    const int place = system_.pattern().find(own.equation, own.equation);
    own.rate = place >= 0 ? highest_rates_[static_cast<std::size_t>(place)] : 0;
  }
}

void Convergence::measure_terms(const NewtonMatrix& linear, const State& state) {
  constexpr double steps = 1e3;
  const int first_amplitude = system_.kinematics().unknowns(), first = system_.dofs();
  for (const Own& own : own_) {
    const bool amplitude = own.equation < first;
    const int k = own.equation - (amplitude ? first_amplitude : first);
    const double value = std::abs((amplitude ? state.amplitude : state.first_order)[k]);
    const double rate = std::abs((amplitude ? state.amplitude_acceleration : state.first_order_rate)[k]);
    const double weight = amplitude ? linear.weights().mass : linear.weights().first_order;
    const double all = linear.diagonal(own.equation), rest = all - weight * own.rate;
    const double slow = own.scale / (amplitude ? steps * steps : steps);
    double terms =
        std::max({std::abs(rest) * std::max(value, own.scale), std::abs(own.rate) * rate, std::abs(all) * slow});
    if (terms == 0) terms = own.rounding / rounding_of_a_sum;
    floor_[own.equation] = own.rounding + options_.tolerance * terms;
  }
  if (!own_.empty()) measured_ = false;
}

Convergence::Tolerances Convergence::tolerances(const ResidualScale& scale) const {
  Tolerances result{};
  std::copy(scale.largest.begin(), scale.largest.end(), result.begin());
  double& amplitude = result[static_cast<std::size_t>(Kind::amplitude)];
  for (const Kind kind : {Kind::translation, Kind::rotation})
    amplitude = std::max(amplitude, amplitude_per_force_[static_cast<std::size_t>(kind)] * scale[kind]);
  result[static_cast<std::size_t>(Kind::multiplier)] =
      std::max(scale[Kind::translation], scale[Kind::rotation]) / scale_;
  for (double& value : result) value *= options_.tolerance;
  return result;
}

bool Convergence::reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale) {
  worst_ = -1;
  worst_ratio_ = worst_residual_ = 0;
  const Tolerances allowed = tolerances(scale);
  for (int i = 0; i < system_.size(); ++i) {
    const double residual = std::abs(r[i]);
    // The ratio is only computed if it may exceed the largest so far.
    const double most = allowed[static_cast<std::size_t>(judged_by_[static_cast<std::size_t>(i)])] + floor_[i];
    if (residual == 0 || residual <= worst_ratio_ * most) continue;
    worst_ratio_ = residual / most;
    worst_ = i;
    worst_residual_ = r[i];
    if (!std::isfinite(residual)) return false;
  }
  return worst_ratio_ <= 1;
}

bool Convergence::out_of_reach(double size, const ResidualScale& scale) const {
  if (!measured_) return false;
  const Tolerances allowed = tolerances(scale);
  double growth = 1;  // growth of the tolerances since the rounding was measured
  for (std::size_t k = 0; k < kind_count; ++k)
    if (allowed[k] > measured_by_[k] * growth) growth = allowed[k] / measured_by_[k];
  constexpr double rounding = 1e-9;
  return size > growth * (1 + rounding);
}

void Convergence::measure_by(const ResidualScale& scale) {
  const Tolerances allowed = measured_by_ = tolerances(scale);
  measure_.resize(system_.size());
  for (int i = 0; i < system_.size(); ++i) {
    const double most = allowed[static_cast<std::size_t>(judged_by_[static_cast<std::size_t>(i)])] + floor_[i];
    // Tolerances below the smallest normal number are ignored, because their inverse would overflow.
    measure_[i] = most > std::numeric_limits<double>::min() ? 1 / most : 0;
  }
  measured_ = true;
}

double Convergence::size_of(const Eigen::Ref<const VectorX>& r) const {
  if (r.size() == 0) return 0;
  const double size = measure_.cwiseProduct(r.cwiseAbs()).maxCoeff<Eigen::PropagateNaN>();
  return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}

std::string Convergence::worst() const {
  if (worst_ < 0) return "none";
  if (!std::isfinite(worst_residual_))
    return fmt::format("{}, which is too large for a number (overflow)", system_.equation_name(worst_));
  return fmt::format("{} ({:.2g} {})", system_.equation_name(worst_), worst_residual_, system_.equation_units(worst_));
}

}  // namespace bielle::mechanism
