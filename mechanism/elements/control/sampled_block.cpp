#include "mechanism/elements/control/sampled_block.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Places in the memory: the number of the next instant, the number of samples that wait for the end of the delay, the
/// place of the oldest of them in the ring, the states of the law, and the ring: the number of the instant of each
/// sample, and its outputs.
enum SampledMemory : Eigen::Index { next_instant_number, samples_waiting, oldest_sample, first_state };

}  // namespace

SampledBlock::SampledBlock(const std::string& name, const SampleClock& clock, const OutputStage& stage,
                           std::unique_ptr<SampledLaw> law)
    : Component("sampled", name),
      clock_(clock),
      stage_(stage),
      law_(std::move(law)),
      places_(static_cast<Eigen::Index>(clock.most_waiting())) {}

Eigen::Index SampledBlock::memories(const SampleClock& clock, const SampledLaw& law) {
  return first_state + law.states() + static_cast<Eigen::Index>(clock.most_waiting()) * (1 + law.outputs());
}

void SampledBlock::add_output(const Measure& output) { references_.add(output); }

void SampledBlock::read_input(const YamlValue& formula, Model& model) {
  inputs_.push_back(read_state_formula(formula, {"t"}, model, references_));
}

void SampledBlock::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.memory.assign(static_cast<std::size_t>(memories(clock_, *law_)), 0.0);
  declaration.passive = true;
  for (const StateFormula& each : inputs_)
    if (each.reads_reactions()) declaration.passive = !(declaration.reads_reactions = true);
}

void SampledBlock::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& each : inputs_) each.add_break_points(0, times);
}

bool SampledBlock::knows_memory(const LocalState& state) const {
  const auto memory = state.memory();
  const auto counts = [](double number) { return number >= 0 && number == std::floor(number); };
  const double next = memory[next_instant_number], waiting = memory[samples_waiting], oldest = memory[oldest_sample];
  if (!counts(next) || !counts(waiting) || !counts(oldest)) return false;
  const auto places = static_cast<double>(places_);
  if (waiting > places || (oldest > 0 && oldest >= places)) return false;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(waiting); ++k)
    if (const double number = memory[place_of(memory[oldest_sample], k)]; !counts(number) || number >= next)
      return false;
  return true;
}

/// Returns the place in the memory of the k-th of the samples that wait, the oldest of which is `oldest` in the ring.
Eigen::Index SampledBlock::place_of(double oldest, Eigen::Index k) const {
  const Eigen::Index in_ring = (static_cast<Eigen::Index>(oldest) + k) % places_;
  return first_state + law_->states() + in_ring * (1 + law_->outputs());
}

VectorX SampledBlock::input(const LocalState& state) const {
  const double t = state.time();
  VectorX u(static_cast<Eigen::Index>(inputs_.size()));
  for (std::size_t k = 0; k < inputs_.size(); ++k) u[static_cast<Eigen::Index>(k)] = inputs_[k].value(state, {&t, 1});
  return u;
}

/// @returns whether an output has changed
bool SampledBlock::put_out(const LocalState& state, const Eigen::Ref<const VectorX>& y,
                           Eigen::Ref<VectorX> memory) const {
  bool changed = false;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (!std::isfinite(y[k]))
      throw ComputationError(
          fmt::format("t = {:.6g} s: an output of state '{}' is not a finite number", state.time(), name()));
    double& held = memory[state.slots().references[static_cast<std::size_t>(k)]->memory_begin];
    changed = changed || held != y[k];
    held = y[k];
  }
  return changed;
}

/// Puts out the samples whose delay has ended, the oldest first. @returns whether an output has changed
bool SampledBlock::put_out_waiting(const LocalState& state, Eigen::Ref<VectorX> own, Eigen::Ref<VectorX> memory) const {
  bool changed = false;
  while (own[samples_waiting] > 0) {
    const Eigen::Index place = place_of(own[oldest_sample], 0);
    if (!clock_.has_come(clock_.instant(own[place]) + clock_.delay, state.time())) break;
    if (put_out(state, own.segment(place + 1, law_->outputs()), memory)) changed = true;
    own[oldest_sample] = static_cast<double>((static_cast<Eigen::Index>(own[oldest_sample]) + 1) % places_);
    --own[samples_waiting];
  }
  return changed;
}

bool SampledBlock::sample(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const double now = state.time();
  auto own = memory.segment(state.slots().memory_begin, state.slots().memories);
  double& next = own[next_instant_number];
  const bool changed = put_out_waiting(state, own, memory);
  if (!clock_.has_come(clock_.instant(next), now)) return changed;
  const VectorX y = law_->step(input(state), stage_, own.segment(first_state, law_->states()));
  next = clock_.number_after(now);
  if (clock_.has_come(clock_.instant(next - 1) + clock_.delay, now)) return put_out(state, y, memory) || changed;
  const Eigen::Index place = place_of(own[oldest_sample], static_cast<Eigen::Index>(own[samples_waiting]));
  own[place] = next - 1;
  own.segment(place + 1, law_->outputs()) = y;
  ++own[samples_waiting];
  return changed;
}

void SampledBlock::describe(const LocalState& /*state*/, Description& description) const {
  std::vector<std::string> texts;
  for (const StateFormula& each : inputs_) texts.push_back(each.text());
  description.add(fmt::format("{} {}, each {:.6g} s", law_->about(), fmt::join(texts, ", "), clock_.period));
  if (clock_.first > 0) description.add(fmt::format("first at {:.6g} s", clock_.first));
  if (clock_.delay > 0) description.add(fmt::format("delay {:.6g} s", clock_.delay));
  if (stage_.quantum > 0) description.add(fmt::format("steps of {:.6g}", stage_.quantum));
  if (std::isfinite(stage_.least) || std::isfinite(stage_.most))
    description.add(fmt::format("between {:.6g} and {:.6g}", stage_.least, stage_.most));
}

}  // namespace bielle::mechanism
