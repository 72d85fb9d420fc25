#include "mechanism/elements/forces/force_formulas.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {

void ForceFormulas::read(const YamlValue& components, bool moment, const char* expected, Model& model,
                         References& references) {
  if (!components.is_sequence() || components.size() != 3) components.fail(expected);
  (moment ? has_moment_ : has_force_) = true;
  for (std::size_t k = 0; k < 3; ++k) {
    StateFormula& component = components_[(moment ? 3 : 0) + k];
    component = read_state_formula(components.at(k), {"t"}, model, references);
    if (component.is_constant()) warn_outside(components.at(k), components.at(k).number(), plausible_load);
  }
}

void ForceFormulas::declare(Declaration& declaration) const {
  for (const StateFormula& component : components_) {
    if (component.reads_state()) declaration.damping = true;
    if (component.reads_reactions()) declaration.reads_reactions = true;
  }
}

void ForceFormulas::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& component : components_) component.add_break_points(0, times);
}

std::vector<TimeDependent::Formula> ForceFormulas::time_formulas() const {
  std::vector<TimeDependent::Formula> formulas;
  for (std::size_t k = 0; k < 6; ++k)
    if (components_[k].holds_time())
      formulas.push_back({fmt::format("{} {}", k < 3 ? "force" : "moment", "xyz"[k % 3]), k < 3 ? "N" : "N m"});
  return formulas;
}

void ForceFormulas::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const double t = state.time();
  std::size_t next = 0;
  for (const StateFormula& component : components_)
    if (component.holds_time()) values[next++] = component.value(state, {&t, 1});
}

void ForceFormulas::evaluate(const LocalState& state, Vector3& force, Vector3& moment) const {
  const double t = state.time();
  for (std::size_t k = 0; k < 6; ++k)
    (k < 3 ? force : moment)[static_cast<Eigen::Index>(k % 3)] =
        state.environment().load_factor * components_[k].value(state, {&t, 1});
}

std::string ForceFormulas::text(std::size_t first) const {
  return fmt::format("({}, {}, {})", components_[first].text(), components_[first + 1].text(),
                     components_[first + 2].text());
}

}  // namespace bielle::mechanism
