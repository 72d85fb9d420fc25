#include "mechanism/solvers/dynamics/start_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Computes forward differences of the consistent accelerations along the motion, because functions of time may not
/// exist before the start. The difference step only has to be small relative to h.
VectorX acceleration_rate(const SchemeStep& step, const Environment& environment, KktMatrix& saddle, double h) {
  const System& system = step.system();
  const State& state = step.state();
  const VectorX &v = step.rates().v, &a = step.rates().a;
  const double e = 0.05 * h;
  VectorX ahead[2];
  for (const int k : {1, 2}) {
    State shifted = state;
    shifted.time = state.time + k * e;
    system.displace(shifted, state, k * e * v + 0.5 * k * k * e * e * a);
    system.set_rates(shifted, v + k * e * a, a);
    shifted.first_order = state.first_order + k * e * state.first_order_rate;
    continue_accelerations(system, environment, shifted, saddle);
    VectorX unused(system.dofs());
    ahead[k - 1].resize(system.dofs());
    system.get_rates(shifted, unused, ahead[k - 1]);
  }
  return (4 * ahead[0] - ahead[1] - 3 * a) / (2 * e);
}

/// Returns whether accelerations change little within a step. The criterion for each kind is that they change by less
/// than their size, or that the velocities change little if accelerations happen to vanish (an oscillator at its
/// centre: h^2 j / v = (omega h)^2).
bool resolved(const SchemeStep& step, const VectorX& j, double h) {
  constexpr double little = 0.01;
  const System& system = step.system();
  std::array<double, kind_count> velocity{}, acceleration{}, rate{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    velocity[kind] = std::max(velocity[kind], std::abs(step.rates().v[i]));
    acceleration[kind] = std::max(acceleration[kind], std::abs(step.rates().a[i]));
    rate[kind] = std::max(rate[kind], std::abs(j[i]));
  }
  // Parts that turn in place have only rounding errors as rates of translations, and parts that only translate have
  // them as rates of rotations.
  constexpr double rounding = 1e-9;
  const double length = model_length(step.state());
  double &along = rate[static_cast<std::size_t>(Kind::translation)],
         &about = rate[static_cast<std::size_t>(Kind::rotation)];
  if (along <= rounding * length * about) along = 0;
  if (length * about <= rounding * along) about = 0;
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (h * rate[kind] > acceleration[kind] && h * h * rate[kind] > little * velocity[kind]) return false;
  return true;
}

}  // namespace

void set_start_values(SchemeStep& step, const Environment& environment, VelocityCorrection& correction, double h) {
  SchemeStep::Rates& rates = step.rates();
  KktMatrix& saddle = correction.saddle();
  step.set_size(h);
  if (!saddle.serves()) saddle.factor(environment, step.state());
  try {
    rates.j = acceleration_rate(step, environment, saddle, h);
  } catch (const ComputationError&) {
    // A component has no value at the later time, or there are no accelerations: the steps of this size will fail and
    // become shorter.
    rates.j.setZero(step.rates().a.size());
  }
  if (resolved(step, rates.j, h)) {
    rates.A = rates.a + step.scheme().delta() * h * rates.j;
    correction.add_offset(step, rates.j, h * h);
    step.set_rates();
  }
  saddle.serve_no_more();
}

void change_step_size(SchemeStep& step, VelocityCorrection& correction, double h) {
  SchemeStep::Rates& rates = step.rates();
  const double before = step.size();
  if (resolved(step, rates.j, std::max(h, before))) {
    rates.A += step.scheme().delta() * (h - before) * rates.j;
    correction.add_offset(step, rates.j, h * h - before * before);
    correction.saddle().serve_no_more();
    step.set_rates();
  }
  step.set_size(h);
}

}  // namespace bielle::mechanism
