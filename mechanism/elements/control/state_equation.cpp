#include "mechanism/elements/control/state_equation.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

StateEquation::StateEquation(const StateUnknowns& unknowns, LinearBlock block, std::optional<MatrixX> rest,
                             std::string about)
    : Component(unknowns.type(), unknowns.name()),
      unknowns_(unknowns),
      block_(std::move(block)),
      rest_(std::move(rest)),
      about_(std::move(about)) {
  references_.add(unknowns);
}

void StateEquation::read_input(const YamlValue& formula, Model& model) {
  inputs_.push_back(read_state_formula(formula, {"t"}, model, references_));
}

void StateEquation::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  for (const StateFormula& each : inputs_) {
    if (each.reads_state()) declaration.damping = true;
    if (each.reads_reactions()) declaration.reads_reactions = true;
  }
  if (!rest_) return;
  declaration.starts_by_state = true;
  declaration.memory = {0};  // tells whether the equation has begun
}

VectorX StateEquation::input(const LocalState& state) const {
  const double t = state.time();
  VectorX u(static_cast<Eigen::Index>(inputs_.size()));
  for (std::size_t k = 0; k < inputs_.size(); ++k) u[static_cast<Eigen::Index>(k)] = inputs_[k].value(state, {&t, 1});
  return u;
}

void StateEquation::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const LocalState of_unknowns = state.of(0);
  const VectorX rates = block_.A * of_unknowns.first_order() + block_.B * input(state);
  const int row = state.slots().reference_row(0);
  for (int k = 0; k < size(); ++k)
    if (!of_unknowns.held(k)) r[row + k] -= rates[k];
}

void StateEquation::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const LocalState of_unknowns = state.of(0);
  const int row = state.slots().reference_row(0), n = size();
  const double t = state.time();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    for (int k = 0; k < n; ++k)
      if (!of_unknowns.held(k)) K.block(row + k, row, 1, n) -= block_.A.row(k);
  }
  for (std::size_t j = 0; j < inputs_.size(); ++j) {
    if (!inputs_[j].reads_state()) continue;
    thread_local FormulaGradient gradient;
    inputs_[j].calc(state, {&t, 1}, gradient);
    for (int k = 0; k < n; ++k) {
      const double factor = block_.B(k, static_cast<Eigen::Index>(j));
      if (factor == 0 || of_unknowns.held(k)) continue;
      if (tangent.wants_K) tangent.K.dense().row(row + k) -= factor * gradient.by_state.position().transpose();
      if (tangent.wants_C) tangent.C.dense().row(row + k) -= factor * gradient.by_state.rate().transpose();
    }
  }
}

void StateEquation::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  pattern.add_block(slots.reference_row(0), 0, size(), slots.size());
}

void StateEquation::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  if (!rest_ || state.memory()[0] != 0) return;
  change.segment(state.slots().reference_row(0), size()) += *rest_ * input(state) - state.of(0).first_order();
}

void StateEquation::accept(const LocalState& /*state*/, Eigen::Ref<VectorX> memory) const { memory[0] = 1; }

void StateEquation::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& each : inputs_) each.add_break_points(0, times);
}

std::vector<TimeDependent::Formula> StateEquation::time_formulas() const {
  std::vector<Formula> formulas;
  for (const StateFormula& each : inputs_)
    if (each.holds_time()) formulas.push_back({each.text(), ""});
  return formulas;
}

void StateEquation::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const double t = state.time();
  std::size_t next = 0;
  for (const StateFormula& each : inputs_)
    if (each.holds_time()) values[next++] = each.value(state, {&t, 1});
}

void StateEquation::describe(const LocalState& /*state*/, Description& description) const {
  std::vector<std::string> texts;
  for (const StateFormula& each : inputs_) texts.push_back(each.text());
  description.add(fmt::format("{} {}", about_, fmt::join(texts, ", ")));
  if (rest_)
    description.add(type() == "filter" ? "starts at its input" : "starts in equilibrium");
  else
    description.add(fmt::format("starts at {:.6g}", fmt::join(unknowns_.start(), ", ")));
}

}  // namespace bielle::mechanism
