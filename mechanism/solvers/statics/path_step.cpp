#include "mechanism/solvers/statics/path_step.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
PathStep::PathStep(const LoadRamp& ramp, const NewtonOptions& options, const State& state)
    : ramp_(ramp),
      system_(ramp.system()),
      options_(options),
      tangent_(system_),
      convergence_(system_, options),
      reactions_(system_),
      weights_(system_.dofs()),
      extent_(model_extent(state)) {
  tangent_.look_for_loose(state, ramp.environment(ramp.begin()));
  std::array<double, kind_count> count{}, stiffness{};
  const auto place = [&](int dof) { return static_cast<std::size_t>(system_.kind(dof)); };
  for (int i = 0; i < system_.dofs(); ++i) {
    count[place(i)] += 1;
    stiffness[place(i)] += std::abs(tangent_.linear().diagonal(i));
  }
  constexpr auto translation = static_cast<std::size_t>(Kind::translation),
                 amplitude = static_cast<std::size_t>(Kind::amplitude);
  // A modal amplitude with the same energy as a displacement of the mechanism's size has the same weight.
  const double unit_work = count[translation] > 0 && stiffness[translation] > 0
                               ? stiffness[translation] / count[translation] * extent_ * extent_
                               : stiffness[amplitude] / std::max(1.0, count[amplitude]);
  for (int i = 0; i < system_.dofs(); ++i) {
    double weight = 1;  // weight of rotations
    if (system_.kind(i) == Kind::translation) weight = 1 / (extent_ * extent_);
    if (system_.kind(i) == Kind::amplitude)
      weight = unit_work > 0 ? std::abs(tangent_.linear().diagonal(i)) / unit_work : 1;
    weights_[i] = weight / count[place(i)];
  }
}

double PathStep::product(const VectorX& a, const VectorX& b) const {
  const Eigen::Index n = system_.dofs();
  return a.head(n).cwiseProduct(weights_).dot(b.head(n));
}

void PathStep::place(const State& base, PathTrial& trial) const {
  trial.state.motion_factor = ramp_.motion(trial.factor);
  system_.displace(trial.state, base, trial.delta.head(system_.dofs()));
  trial.state.first_order = base.first_order + trial.delta.segment(system_.dofs(), system_.first_orders());
  trial.state.multiplier = base.multiplier + trial.delta.tail(system_.multipliers());
}

bool PathStep::response(const State& state, double factor, VectorX& b) {
  if (!tangent_.try_factor(state, ramp_.environment(factor))) return false;
  VectorX r(system_.size());
  ramp_.factor_derivative(state, factor, r);
  b.resize(system_.size());
  tangent_.solve(r, b);
  return b.allFinite();
}

bool PathStep::correct(const State& base, const PathCondition& condition, double longest, PathTrial& trial) {
  why_.clear();
  trial.state = base;
  try {
    return iterate(base, condition, longest, trial);
  } catch (const ComputationError& error) {
    why_ = fmt::format("load factor {:.6g}: {}", trial.factor, error.what());  // a component cannot be evaluated
    return false;
  }
}

bool PathStep::iterate(const State& base, const PathCondition& condition, double longest, PathTrial& trial) {
  VectorX r(system_.size()), by_factor(system_.size()), a(system_.size()), b(system_.size());
  ResidualScale scale;
  State before = base;  // one linear step led from it to the trial
  for (trial.iterations = 0;; ++trial.iterations) {
    const Environment environment = ramp_.environment(trial.factor);
    place(base, trial);
    reactions_.balance(environment, trial.state);
    residual_at_rest(system_, environment, trial.state, r, &scale);
    const double g = condition.value(trial);
    const bool reached = convergence_.reached(r, scale);
    if (trial.iterations > 0 && reached && std::abs(g) <= condition.tolerance()) return true;
    if (trial.iterations == options_.iterations || !r.allFinite() || !std::isfinite(g)) {
      why_ = fmt::format("Newton did not converge at load factor {:.6g}; largest residual: {}", trial.factor,
                         convergence_.worst());
      return false;
    }
    const VectorX increment = trial.delta.head(system_.dofs());
    Environment predicted = environment;
    predicted.before = &before;
    tangent_.factor(trial.state, predicted, 0, &increment);
    convergence_.measure_rounding(tangent_.linear(), trial.state);
    tangent_.solve(r, a);
    ramp_.factor_derivative(trial.state, trial.factor, by_factor);
    tangent_.solve(by_factor, b);
    const double change = -(g + condition.slope(trial, a, 0)) / condition.slope(trial, b, 1);
    before = trial.state;
    trial.delta += a + change * b;
    trial.factor += change;
    if (!(length(trial.delta) <= longest)) {
      why_ = fmt::format("Newton left the neighbourhood of the path at load factor {:.6g}; largest residual: {}",
                         trial.factor, convergence_.worst());
      return false;
    }
  }
}

}  // namespace bielle::mechanism
