#include "mechanism/solvers/dynamics/pulse_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "mechanism/solvers/dynamics/prescribed_node.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

const Slots no_slots;

constexpr int least_parts = 4, most_parts = 20000;
/// Permitted distance of a force from the chord between the ends, relative to its range: about seven steps in a period.
constexpr double visible = 0.05;
/// Permitted distance of a prescribed position from the cubic between the ends, relative to its range: about five steps
/// in a period.
constexpr double visible_position = 0.003;
/// Changes below this fraction of |f| are ignored.
constexpr double nothing = 1e-3;
/// Motions below this fraction of the model's length, or of 1 rad, are ignored.
constexpr double no_motion = 1e-9;

}  // namespace

PulseWatch::PulseWatch(const System& system, double begin, double span, double length)
    : system_(system), span_(span), length_(length) {
  step_.reference = begin;
  const Model& model = system.model();
  for (std::size_t m = 0; m < model.members().size(); ++m)
    if (const auto* component = dynamic_cast<const TimeDependent*>(model.members()[m].component.get()))
      add_source(nullptr, *component, describe(model.members()[m]), m, system.slots()[m]);
  for (const Node& node : model.nodes()) {
    auto prescribed = std::make_unique<PrescribedNode>(node);
    const PrescribedNode& motions = *prescribed;
    add_source(std::move(prescribed), motions, fmt::format("node '{}'", node.name), model.members().size(), no_slots);
  }
  looks_.resize(totals_.size());
}

void PulseWatch::add_source(std::unique_ptr<TimeDependent> own, const TimeDependent& component, const std::string& name,
                            std::size_t member, const Slots& slots) {
  std::vector<TimeDependent::Formula> formulas = component.time_formulas();
  if (formulas.empty()) return;
  Source source{&component, member, &slots, std::move(formulas), totals_.size()};
  for (const TimeDependent::Formula& formula : source.formulas) {
    source.forces = source.forces || formula.part == TimeDependent::Part::force;
    totals_.push_back({name + ": " + formula.name});
  }
  sources_.push_back(std::move(source));
  if (own) nodes_.push_back(std::move(own));
}

/// Calls act(formula, number) for each formula.
template <class Act>
void PulseWatch::for_each_formula(const Act& act) const {
  for (const Source& source : sources_)
    for (std::size_t k = 0; k < source.formulas.size(); ++k) act(source.formulas[k], source.first + k);
}

double PulseWatch::range(const Total& total) { return std::max(total.high - total.low, nothing * total.largest); }

void PulseWatch::look(const State& end, const Environment& environment, double begin_time, double end_time) {
  step_.begin = begin_time;
  step_.end = end_time;
  step_.parts = std::clamp(static_cast<int>(std::ceil(most_parts * step_.size() / span_)), least_parts, most_parts);
  state_ = end;
  ++count_;
  for (const Source& source : sources_) {
    const std::span<FormulaLook> looks(looks_.data() + source.first, source.formulas.size());
    try {
      looker_.look(*source.component, source.formulas, state_, *source.slots, environment, step_, looks);
    } catch (const ComputationError&) {
      // A formula that also depends on the state may have no value at times that do not belong to this state.
      std::fill(looks.begin(), looks.end(), FormulaLook{});
    }
    for (std::size_t k = 0; k < looks.size(); ++k) {
      Total& total = totals_[source.first + k];
      total.low = std::min(total.low, looks[k].low);
      total.high = std::max(total.high, looks[k].high);
      total.largest = std::max(total.largest, looks[k].largest);
    }
  }
}

// -- adaptive steps

double PulseWatch::error(const Environment& environment, const ErrorNorm& norm, double tolerance) {
  return std::max(of_motions(norm, tolerance), of_forces(environment, norm, tolerance));
}

double PulseWatch::of_motions(const ErrorNorm& norm, double tolerance) const {
  if (step_.size() * most_parts < span_) return 0;  // steps shorter than these pulses show them by the accelerations
  double error = 0;
  for_each_formula([&](const TimeDependent::Formula& formula, std::size_t k) {
    if (formula.part == TimeDependent::Part::force) return;
    error = std::max(error, looks_[k].missed / (formula.turns ? 1 : norm.length()) / tolerance);
  });
  return error;
}

double PulseWatch::missed_by(const Source& source) const {
  double sum = 0;
  for (std::size_t k = 0; k < source.formulas.size(); ++k)
    if (source.formulas[k].part == TimeDependent::Part::force) sum += looks_[source.first + k].missed;
  return sum;
}

/// Estimates the error of a source's impulse from its formulas and their earlier effect; negative if it is not known.
double PulseWatch::estimate(const Source& source) const { return source.gain * step_.size() * missed_by(source); }

/// Returns whether the impulse of a source must be computed. @param large  an estimate that is significant
bool PulseWatch::wants_impulse(const Source& source, double large) const {
  constexpr std::size_t refresh = 32;  // number of steps after which the effect of a formula may have changed
  if (source.gain < 0 || estimate(source) > large) return true;
  if (count_ % refresh == 0 &&
      count_ / refresh % sources_.size() == static_cast<std::size_t>(&source - sources_.data()))
    return true;
  for (std::size_t k = source.first; k < source.first + source.formulas.size(); ++k)
    if (looks_[k].off > 0.5 * visible * range(totals_[k])) return true;
  return false;
}

/// Computes int r dt - h (r_n + r_{n+1})/2 of a component's part of the residual.
void PulseWatch::set_impulse(const Source& source, const Environment& environment) {
  const auto add = [&](double time, double weight) {
    state_.time = time;
    system_.residual_part(source.member, state_, environment, part_);
    impulse_ += weight * part_;
  };
  part_.resize(system_.size());
  impulse_.setZero(system_.size());
  const double h = step_.size();
  add(step_.begin + step_.inside(), -0.5 * h);
  add(step_.end - step_.inside(), -0.5 * h);
  for (int i = 0; i < step_.parts; ++i) add(step_.middle(i), h / step_.parts);
}

/// Returns whether the impulse acts on an algebraic unknown. If it acts on other unknowns as well, their error is used.
bool PulseWatch::acts_on_algebraic() const {
  const std::vector<int>& algebraic = system_.algebraic();
  return std::any_of(algebraic.begin(), algebraic.end(), [&](int k) { return impulse_[system_.dofs() + k] != 0; });
}

double PulseWatch::of_forces(const Environment& environment, const ErrorNorm& norm, double tolerance) {
  constexpr double little = 0.3;  // fraction of the tolerance
  double all = 0;
  for (const Source& source : sources_) all += std::max(0.0, estimate(source));
  const double large = all > little * tolerance ? little * tolerance / static_cast<double>(sources_.size())
                                                : std::numeric_limits<double>::infinity();
  double followed = 0;  // error of the formulas that steps have to resolve
  bool any = false;
  sum_.setZero(system_.size());
  for (Source& source : sources_) {
    const double missed = source.forces ? missed_by(source) : 0;
    if (!(missed > 0)) continue;
    if (wants_impulse(source, large)) {
      try {
        set_impulse(source, environment);
      } catch (const ComputationError&) {
        continue;  // the component has no value for this state at that time
      }
      source.gain = norm.of_impulse(impulse_, step_.size()) / (missed * step_.size());
      source.on_algebraic = source.gain == 0 && acts_on_algebraic();
      sum_ += impulse_;
      any = true;
    }
    if (source.on_algebraic && step_.size() * most_parts > span_)
      for (std::size_t k = source.first; k < source.first + source.formulas.size(); ++k)
        followed = std::max(followed, looks_[k].off / (visible * range(totals_[k])));
  }
  const double error = any ? norm.of_impulse(sum_, step_.size()) / tolerance : 0;
  return followed > 1 ? std::max(error, followed) : error;
}

// -- fixed steps

void PulseWatch::add(double end_time) {
  for_each_formula([&](const TimeDependent::Formula& formula, std::size_t k) {
    Total& total = totals_[k];
    const FormulaLook& look = looks_[k];
    if (formula.part == TimeDependent::Part::position)
      total.missed = std::max(total.missed, look.missed);
    else
      total.missed += look.missed;
    total.whole += look.whole;
    total.off = std::max(total.off, look.off);
    if (!(look.missed > total.most)) return;
    total.most = look.missed;
    total.most_at = end_time;
  });
}

std::vector<std::string> PulseWatch::warnings() const {
  std::vector<std::string> warnings;
  std::set<std::string> named;  // elements of one beam have the same name
  for_each_formula([&](const TimeDependent::Formula& formula, std::size_t k) {
    const Total& total = totals_[k];
    if (formula.part == TimeDependent::Part::position) {
      const double extent = formula.turns ? 1 : length_, size = std::min(range(total), extent);
      if (!(total.off > std::max(visible_position * size, no_motion * extent))) return;
      if (!named.insert(total.name).second) return;
      warnings.push_back(
          fmt::format("{} moves between steps: up to {:.4g} {} away from the curve through their ends, farthest in the "
                      "step to t = {:.6g} s; take smaller steps",
                      total.name, total.missed, formula.units, total.most_at));
      return;
    }
    if (!(total.off > visible * range(total)) || !named.insert(total.name).second) return;
    const std::string units = formula.units.empty() ? "s" : formula.units + " s";
    warnings.push_back(fmt::format(
        "{} changes between steps: of the integral of its changes over time, {:.4g} {}, they miss {:.4g} {}, most of "
        "it in the step to t = {:.6g} s; take smaller steps",
        total.name, total.whole, units, total.missed, units, total.most_at));
  });
  return warnings;
}

}  // namespace bielle::mechanism
