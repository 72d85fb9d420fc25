#include "mechanism/solvers/dynamics/formula_look.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bielle::mechanism {
namespace {

/// Returns the cubic through values and rates at both ends. @param s  0 .. 1, of a step of size h
double cubic(double s, double h, double begin, double begin_rate, double end, double end_rate) {
  return (1 - s) * (1 - s) * ((1 + 2 * s) * begin + s * h * begin_rate) +
         s * s * ((3 - 2 * s) * end - (1 - s) * h * end_rate);
}

}  // namespace

void FormulaLooker::look(const TimeDependent& component, const std::vector<TimeDependent::Formula>& formulas,
                         State& state, const Slots& slots, const Environment& environment, const LookedStep& step,
                         std::span<FormulaLook> looks) {
  const std::size_t n = formulas.size();
  const double h = step.size(), part = h / step.parts;
  const LocalState local(state, slots, environment);
  const auto calc = [&](double time, std::vector<double>& values) {
    values.resize(n);
    state.time = time;
    component.calc_time_formulas(local, values);
  };
  const auto is_position = [&](std::size_t k) { return formulas[k].part == TimeDependent::Part::position; };
  calc(step.reference, reference_);
  const double first = step.begin + step.inside(), last = step.end - step.inside();
  calc(first, begin_);
  calc(last, end_);
  bool positions = false;
  for (std::size_t k = 0; k < n; ++k) positions = positions || is_position(k);
  if (positions) {
    // Rates are computed from values within the step, to second order.
    const double e = 0.01 * h;
    for (const auto& [values, rate, from, to] :
         {std::tuple(&begin_, &begin_rate_, first, e), std::tuple(&end_, &end_rate_, last, -e)}) {
      calc(from + to, value_);
      calc(from + 2 * to, sum_);
      rate->resize(n);
      for (std::size_t k = 0; k < n; ++k) (*rate)[k] = (4 * value_[k] - 3 * (*values)[k] - sum_[k]) / (2 * to);
    }
  }
  sum_.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const double begin = begin_[k] - reference_[k], end = end_[k] - reference_[k];
    looks[k] = {0,
                0,
                0,
                std::min({0.0, begin, end}),
                std::max({0.0, begin, end}),
                std::max({std::abs(begin_[k]), std::abs(end_[k]), std::abs(reference_[k])})};
  }
  for (int i = 0; i < step.parts; ++i) {
    const double time = step.middle(i), s = (time - step.begin) / h;
    calc(time, value_);
    for (std::size_t k = 0; k < n; ++k) {
      FormulaLook& look = looks[k];
      const double f = value_[k], change = f - reference_[k];
      const double told = is_position(k) ? cubic(s, h, begin_[k], begin_rate_[k], end_[k], end_rate_[k])
                                         : (1 - s) * begin_[k] + s * end_[k];
      sum_[k] += part * (f - told);  // midpoints integrate the chord exactly
      look.whole += part * std::abs(change);
      look.off = std::max(look.off, std::abs(f - told));
      look.low = std::min(look.low, change);
      look.high = std::max(look.high, change);
      look.largest = std::max(look.largest, std::abs(f));
    }
  }
  for (std::size_t k = 0; k < n; ++k) looks[k].missed = is_position(k) ? looks[k].off : std::abs(sum_[k]);
}

}  // namespace bielle::mechanism
