#include "mechanism/analyses/step_reader.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

void check_step(const YamlValue& entry, const std::string& key, double step, double duration) {
  constexpr double most_steps = 1e9;  // this number of steps would take years
  if (!(duration / step <= most_steps))
    entry.at(key).fail(fmt::format("{:.3g} s in steps of {:.3g} s are {:.3g} steps; expected at most {:.0e}", duration,
                                   step, duration / step, most_steps));
  if (step > duration)
    entry.at(key).fail(fmt::format("{:.6g} s is longer than the duration, {:.6g} s", step, duration));
}

}  // namespace bielle::mechanism
