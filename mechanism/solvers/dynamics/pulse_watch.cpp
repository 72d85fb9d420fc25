#include "mechanism/solvers/dynamics/pulse_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

PulseWatch::PulseWatch(const System& system, double span) : system_(system), span_(span) {
  const std::vector<Member>& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m) {
    const auto* component = dynamic_cast<const TimeDependent*>(members[m].component.get());
    if (!component) continue;
    const std::vector<TimeDependent::Formula> formulas = component->time_formulas();
    if (formulas.empty()) continue;
    sources_.push_back({m, component, totals_.size(), formulas.size()});
    for (const TimeDependent::Formula& formula : formulas)
      totals_.push_back({describe(members[m]) + ": " + formula.name, formula.units});
  }
  looks_.resize(totals_.size());
  for (std::vector<double>* buffer : {&begin_, &end_, &sum_, &value_}) buffer->resize(totals_.size());
}

/// One component's formulas over a step.
void PulseWatch::look(const Source& source, const LocalState& state, double begin_time, double end_time, int parts) {
  const double h = end_time - begin_time, part = h / parts, inside = 1e-9 * h;  // jumps at the ends are of other steps
  const auto of = [&](std::vector<double>& values) { return std::span(values).subspan(source.first, source.count); };
  source.component->calc_time_formulas(state, begin_time + inside, of(begin_));
  source.component->calc_time_formulas(state, end_time - inside, of(end_));
  const std::size_t end = source.first + source.count;
  for (std::size_t k = source.first; k < end; ++k) sum_[k] = 0;
  for (int i = 0; i < parts; ++i) {
    const double share = (i + 0.5) / parts, time = begin_time + share * h;
    source.component->calc_time_formulas(state, time, of(value_));
    for (std::size_t k = source.first; k < end; ++k) {
      sum_[k] += part * value_[k];
      looks_[k].whole += part * std::abs(value_[k]);
      const double distance = std::abs(value_[k] - (1 - share) * begin_[k] - share * end_[k]);
      if (!(distance > looks_[k].distance)) continue;
      looks_[k].distance = distance;
      looks_[k].farthest = time;
    }
  }
  for (std::size_t k = source.first; k < end; ++k)
    looks_[k].missed = std::abs(0.5 * h * (begin_[k] + end_[k]) - sum_[k]);
}

PulseWatch::Look PulseWatch::look(const State& end, const Environment& environment, double begin_time,
                                  double end_time) {
  constexpr int least = 16, most = 20000;
  const int parts = std::clamp(static_cast<int>(std::ceil(most * (end_time - begin_time) / span_)), least, most);
  Look worst;
  for (const Source& source : sources_) {
    for (std::size_t k = source.first; k < source.first + source.count; ++k) looks_[k] = {k, 0, 0, 0, 0};
    try {
      look(source, LocalState(end, system_.slots()[source.member], environment), begin_time, end_time, parts);
    } catch (const ComputationError&) {
      // A formula of the state as well may have no value at times that this state is not of.
      for (std::size_t k = source.first; k < source.first + source.count; ++k) looks_[k] = {k, 0, 0, 0, 0};
    }
    for (std::size_t k = source.first; k < source.first + source.count; ++k)
      if (looks_[k].missed * worst.whole > worst.missed * looks_[k].whole || worst.missed == 0) worst = looks_[k];
  }
  return worst;
}

void PulseWatch::add(double end_time) {
  for (std::size_t k = 0; k < totals_.size(); ++k) {
    Total& total = totals_[k];
    total.missed += looks_[k].missed;
    total.whole += looks_[k].whole;
    if (!(looks_[k].missed > total.most)) continue;
    total.most = looks_[k].missed;
    total.most_at = end_time;
  }
}

std::vector<std::string> PulseWatch::doubts() const {
  constexpr double tolerable = 0.05;  // eight steps in a period
  std::vector<std::string> doubts;
  for (const Total& total : totals_)
    if (total.missed > tolerable * total.whole)
      doubts.push_back(fmt::format(
          "{} changes between steps: of its integral over time, {:.4g} {} s, they miss {:.4g} {} s, most of "
          "it in the step to t = {:.6g} s; take smaller steps",
          total.name, total.whole, total.units, total.missed, total.units, total.most_at));
  return doubts;
}

}  // namespace bielle::mechanism
