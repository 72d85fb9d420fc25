#include "mechanism/session/motion_steps.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/sampler.hpp"
#include "mechanism/session/time_grid.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

/// Warns if the instants of a state decide the number of steps.
void note_many_instants(const Model& model, double duration, Notes& notes) {
  constexpr double many = 1e6;
  for (const Member& member : model.members())
    if (const auto* sampler = dynamic_cast<const Sampler*>(member.component.get()))
      for (const Sampler::Instants& each : sampler->instants())
        if (const double count = duration / each.period; count > many)
          notes.note(fmt::format("{} has {:.3g} instants in {:.6g} s, one each {:.6g} s: a step ends at each",
                                 describe(member), count, duration, each.period));
}

}  // namespace

StepOptions stepping_of(const DynamicsOptions& options, const System& system, double begin, Notes* notes) {
  StepOptions stepping = options.stepping;
  for (const double time : system.break_points())
    if (time >= begin && time < begin + options.duration) stepping.break_points.push_back(time);
  if (notes) note_many_instants(system.model(), options.duration, *notes);
  if (stepping.tolerance > 0) return stepping;
  const long steps = grid_steps(options.duration, options.stepping.size);
  stepping.size = options.duration / static_cast<double>(steps);
  if (notes && std::abs(stepping.size - options.stepping.size) > 1e-9 * stepping.size)
    notes->note(fmt::format("step {:.6g} s in place of {:.6g} s, so that {} the duration", stepping.size,
                            options.stepping.size, counted(steps, "step fills", "steps fill")));
  if (static_cast<long>(stepping.break_points.size()) > steps) {
    if (notes)
      notes->note(fmt::format("{} of loads and motions in {}: steps do not end there",
                              counted(stepping.break_points.size(), "kink"), counted(steps, "step")));
    stepping.break_points.clear();
  }
  return stepping;
}

}  // namespace bielle::mechanism
