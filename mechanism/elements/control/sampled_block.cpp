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

/// Places in the memory: the number of the next instant, whether outputs wait for the end of the delay, the states of
/// the law, and these outputs.
enum SampledMemory : Eigen::Index { next_instant_number, outputs_wait, first_state };

}  // namespace

SampledBlock::SampledBlock(const std::string& name, const SampleClock& clock, const OutputStage& stage,
                           std::unique_ptr<SampledLaw> law)
    : Component("sampled", name), clock_(clock), stage_(stage), law_(std::move(law)) {}

void SampledBlock::add_output(const Measure& output) { references_.add(output); }

void SampledBlock::read_input(const YamlValue& formula, Model& model) {
  inputs_.push_back(read_state_formula(formula, {"t"}, model, references_));
}

void SampledBlock::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.memory.assign(static_cast<std::size_t>(first_state + law_->states() + law_->outputs()), 0.0);
  declaration.passive = true;
  for (const StateFormula& each : inputs_)
    if (each.reads_reactions()) declaration.passive = !(declaration.reads_reactions = true);
}

void SampledBlock::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& each : inputs_) each.add_break_points(0, times);
}

bool SampledBlock::knows_memory(const LocalState& state) const {
  const double number = state.memory()[next_instant_number], wait = state.memory()[outputs_wait];
  return number >= 0 && number == std::floor(number) && (wait == 0 || wait == 1);
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

bool SampledBlock::sample(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const double now = state.time();
  auto own = memory.segment(state.slots().memory_begin, state.slots().memories);
  double& next = own[next_instant_number];
  auto waiting = own.tail(law_->outputs());
  bool changed = false;
  if (own[outputs_wait] != 0 && clock_.has_come(clock_.instant(next - 1) + clock_.delay, now)) {
    changed = put_out(state, waiting, memory);
    own[outputs_wait] = 0;
  }
  if (!clock_.has_come(clock_.instant(next), now)) return changed;
  const VectorX y = law_->step(input(state), stage_, own.segment(first_state, law_->states()));
  next = clock_.number_after(now);
  if (clock_.has_come(clock_.instant(next - 1) + clock_.delay, now)) return put_out(state, y, memory) || changed;
  waiting = y;
  own[outputs_wait] = 1;
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
