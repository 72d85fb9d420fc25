#include "mechanism/joints/actions/force_drive.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {

void ForceDrive::read(const YamlValue& law, Model& model) {
  law_ = read_state_formula(law, {"t"}, model, references());
  if (law_.is_constant()) warn_outside(law, law.number(), plausible_load);
}

void ForceDrive::declare(Declaration& declaration) const {
  declare_actuator(declaration);
  declaration.reads_reactions = law_.reads_reactions();
}

double ForceDrive::effort(const LocalState& state) const {
  const double t = state.time();
  return law_.value(state, {&t, 1});
}

void ForceDrive::calc_effort(const LocalState& state, Effort& effort) const {
  const double t = state.time();
  thread_local FormulaGradient gradient;
  law_.calc(state, {&t, 1}, gradient);
  effort.value = gradient.value;
  if (!law_.reads_state()) return;
  effort.by_position = gradient.by_state.position();
  effort.by_rate = gradient.by_state.rate();
}

Drive::LawText ForceDrive::law_text() const {
  const bool turning = coordinate().kind != JointCoordinate::Kind::displacement;
  return {fmt::format("{} on {}", turning ? "torque" : "force", coordinate().name), law_.text() + limit_text(),
          coordinate().force_units()};
}

std::vector<TimeDependent::Formula> ForceDrive::time_formulas() const {
  if (!law_.holds_time()) return {};
  const LawText text = law_text();
  return {{text.driven, text.units}};
}

void ForceDrive::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  values[0] = released(state) ? 0 : effort(state);
}

}  // namespace bielle::mechanism
