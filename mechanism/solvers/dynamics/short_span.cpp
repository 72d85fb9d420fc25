#include "mechanism/solvers/dynamics/short_span.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"

namespace bielle::mechanism {

double ShortSpan::longest(const State& state, const Scheme& scheme) const {
  constexpr double digits = 1e6, eps = std::numeric_limits<double>::epsilon();
  const double extent = model_extent(state), size = model_length(state) + extent;
  double largest = environment_.gravity.norm();
  for (const NodeState& node : state.nodes) largest = std::max({largest, node.a.norm(), extent * node.Omegadot.norm()});
  const double share = (1 - scheme.alpha_m) / ((1 - scheme.alpha_f) * scheme.beta);
  return largest > 0 ? std::sqrt(digits * eps * size * share / largest) : std::numeric_limits<double>::infinity();
}

/// Returns whether possibly stiff unknowns move by no more than a small fraction of their size.
bool ShortSpan::moves_little(const State& begin, double span) const {
  constexpr double little = 1e-6;
  for (int k = 0; k < system_.first_orders(); ++k) {
    const double size = std::max(std::abs(begin.first_order[k]), system_.scale(system_.dofs() + k));
    if (span * std::abs(begin.first_order_rate[k]) > little * size) return false;
  }
  if (begin.amplitude.size() == 0) return true;
  return 0.5 * span * span * begin.amplitude_acceleration.lpNorm<Eigen::Infinity>() <=
         little * begin.amplitude.lpNorm<Eigen::Infinity>();
}

/// Returns whether no unknown has an acceleration at the end that would have changed its motion significantly.
bool ShortSpan::is_slow(const State& begin, const State& after, const VectorX& dq, double span) const {
  constexpr double little = 1e-3, rounding = 1e3 * std::numeric_limits<double>::epsilon();
  const double length = model_length(begin) + model_extent(begin),
               amplitude = begin.amplitude.size() > 0 ? begin.amplitude.lpNorm<Eigen::Infinity>() : 0;
  VectorX unused(system_.dofs()), a(system_.dofs()), a_after(system_.dofs());
  system_.get_rates(begin, unused, a);
  system_.get_rates(after, unused, a_after);
  for (int i = 0; i < system_.dofs(); ++i) {
    const Kind kind = system_.kind(i);
    const double size = kind == Kind::translation ? length : kind == Kind::rotation ? 1 : amplitude;
    if (span * span * std::abs(a_after[i] - a[i]) > little * std::abs(dq[i]) + rounding * size) return false;
  }
  return true;
}

bool ShortSpan::leap(SchemeStep& step, KktMatrix& saddle, double span, double end, double offset, bool small) const {
  State begin = step.state();
  begin.time += offset;
  StartReport unused;
  saddle.serve_no_more();
  make_velocities_consistent(system_, environment_, begin, unused, saddle);
  make_accelerations_consistent(system_, environment_, begin, saddle);
  if (!small && !moves_little(begin, span)) return false;
  const int n = system_.dofs();
  VectorX v(n), a(n);
  system_.get_rates(begin, v, a);
  const VectorX dq = span * v + 0.5 * span * span * a;
  State after = begin;
  after.time = end;
  system_.displace(after, begin, dq);
  system_.set_rates(after, v + span * a, a);
  after.first_order += span * begin.first_order_rate;
  continue_accelerations(system_, environment_, after, saddle);
  saddle.serve_no_more();
  if (!small && !is_slow(begin, after, dq, span)) return false;
  step.set_trial(std::move(after), span, dq);
  return true;
}

void ShortSpan::settle(SchemeStep& step, KktMatrix& saddle) const {
  State after = step.trial();
  const VectorX dq = step.dq();
  StartReport unused;
  saddle.serve_no_more();
  make_velocities_consistent(system_, environment_, after, unused, saddle);
  make_accelerations_consistent(system_, environment_, after, saddle);
  saddle.serve_no_more();
  step.set_trial(std::move(after), step.trial_size(), dq);
}

}  // namespace bielle::mechanism
