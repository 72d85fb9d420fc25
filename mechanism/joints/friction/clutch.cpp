#include "mechanism/joints/friction/clutch.hpp"

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

FrictionSurface surface_of(std::size_t coordinate) {
  FrictionSurface surface;
  surface.parts.push_back({coordinate, 0, 1.0});
  return surface;
}

FrictionLaw law_of(double ratio) {
  FrictionLaw law;
  law.model = FrictionLaw::Model::stick_slip;
  law.kinetic = 1;
  law.sticking = ratio;
  return law;
}

}  // namespace

Clutch::Clutch(const Joint& joint, std::size_t coordinate, double ratio)
    : StickSlipFriction("clutch", joint, surface_of(coordinate), law_of(ratio)) {
  references_.add(joint);
}

void Clutch::read(const YamlValue& formula, double factor, Model& model) {
  capacity_ = read_state_formula(formula, {"t"}, model, references_);
  if (capacity_.is_constant() && formula.number() < 0)
    formula.fail(fmt::format("expected a number of at least 0, found {:.6g}", formula.number()));
  factor_ = factor;
}

void Clutch::declare(Declaration& declaration) const {
  StickSlipFriction::declare(declaration);
  references_.declare(declaration);
  declaration.reads_reactions = capacity_.reads_reactions();
  const std::string subject = "clutch on " + coordinate().name;
  declaration.multipliers.back().name = subject;
  declaration.multipliers.back().units = coordinate().force_units();
  declaration.event_functions[0].name = subject + " engages";
  declaration.event_functions[1].name = subject + " slips";
}

double Clutch::checked(double capacity, const LocalState& state) const {
  if (capacity < 0)
    throw ComputationError(
        fmt::format("the capacity of the clutch of joint '{}' is {:.6g} {} at {:.6g} s; it must not be "
                    "negative",
                    name(), capacity, coordinate().force_units(), state.time()));
  return capacity;
}

double Clutch::normal_force(const LocalState& state) const {
  const double t = state.time();
  return checked(factor_ * capacity_.value(state, {&t, 1}), state);
}

double Clutch::calc_normal_force(const LocalState& state, MeasureGradient& gradient) const {
  const double t = state.time();
  Nested<FormulaGradient> formula;
  capacity_.calc(state, {&t, 1}, *formula);
  if (capacity_.reads_state()) {
    gradient.position() = factor_ * formula->by_state.position();
    gradient.rate() = factor_ * formula->by_state.rate();
  }
  return checked(factor_ * formula->value, state);
}

std::vector<OutputField> Clutch::output_fields() const {
  return {joint().force_field("clutch_force", "force or torque of the clutches along the joint's coordinates"),
          joint().force_field("clutch_capacity", "force or torque with which the clutches slip"),
          by_coordinate("clutch_sticks", "-", "1 along the coordinates that a clutch holds, else 0")};
}

void Clutch::write_output(const LocalState& state, double* values) const {
  const std::size_t count = joint().coordinates().size();
  write_by_coordinate(Vector::Constant(1, -resisting_force(state, state.reaction()[0])), values);
  write_by_coordinate(Vector::Constant(1, normal_force(state)), values + count);
  write_by_coordinate(Vector::Constant(1, sticks(state) ? 1 : 0), values + 2 * count);
}

void Clutch::describe(const LocalState& state, Description& description) const {
  std::string text = fmt::format("clutch on {} of capacity {:.6g} {}", coordinate().name, normal_force(state),
                                 coordinate().force_units());
  if (!capacity_.is_constant()) text += " at the start";
  if (law().sticking > 1) text += fmt::format(", begins to slip at {:.6g} times that", law().sticking);
  description.add_line(text);
}

std::vector<TimeDependent::Formula> Clutch::time_formulas() const {
  if (!capacity_.holds_time()) return {};
  return {{"capacity of the clutch on " + coordinate().name, coordinate().force_units()}};
}

void Clutch::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  values[0] = normal_force(state);
}

}  // namespace bielle::mechanism
