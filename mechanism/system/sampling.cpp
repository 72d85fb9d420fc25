#include "mechanism/system/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

double next_instant(const Sampler::Instants& instants, double time, double rounding) {
  const double begun = std::max(0.0, std::floor((time - instants.first) / instants.period));
  // The quotient may be rounded to either side of a whole number.
  for (double k = std::max(0.0, begun - 1);; ++k)
    if (const double at = instants.first + k * instants.period; at > time + rounding) return at;
}

Samplers::Samplers(const System& system) : system_(system) {
  const std::vector<Member>& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (const auto* sampler = dynamic_cast<const Sampler*>(members[m].component.get()))
      samplers_.push_back({sampler, m});
}

std::vector<Sampler::Instants> Samplers::instants() const {
  std::vector<Sampler::Instants> all;
  const auto add = [&](const Sampler::Instants& one) {
    const auto same = [&](const Sampler::Instants& other) {
      return one.first == other.first && one.period == other.period;
    };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(one);
  };
  for (const Placed& each : samplers_)
    for (const Sampler::Instants& one : each.sampler->instants()) add(one);
  return all;
}

bool Samplers::take(State& state, const Environment& environment) const {
  bool changed = false;
  for (const Placed& each : samplers_)
    changed = each.sampler->sample({state, system_.slots()[each.member], environment}, state.memory) || changed;
  return changed;
}

}  // namespace bielle::mechanism
