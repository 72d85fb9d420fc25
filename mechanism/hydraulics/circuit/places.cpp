#include "mechanism/hydraulics/circuit/places.hpp"

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

Declaration::Scalar pressure_unknown(double start) {
  Declaration::Scalar pressure{"pressure", "Pa", start};
  pressure.scale = 1e5;
  pressure.algebraic = true;
  return pressure;
}

constexpr double highest_pressure = 1e12;  // largest pressure of a junction [Pa]: far above that of any fluid
constexpr double below_vacuum = 1e3;       // permitted pressure of a junction below vacuum [Pa]
constexpr const char *pumped_in =
                         "more fluid is pumped in than its lines let out, whatever its pressure; give it a way out (a "
                         "relief valve, a line that is open), or list it under `volumes`, where fluid is compressed",
                     *drawn_out =
                         "more fluid is drawn out than its lines let in, down to vacuum; open its lines, or list it "
                         "under `volumes`, where fluid may cavitate";

OutputField pressure_field(const Fluid& fluid) {
  return {"pressure", {}, "Pa", fluid.ambient == 0 ? "gauge" : "absolute"};
}

}  // namespace

void Junction::declare(Declaration& declaration) const {
  Declaration::Scalar pressure = pressure_unknown(start_);
  pressure.equation_units = "m^3/s";
  declaration.first_order = {pressure};
  declaration.stiffness = true;
  declaration.memory = {start_};
}

FlowBalance::Range Junction::balance_range() const {
  return {0, fluid().vacuum() - below_vacuum, highest_pressure, drawn_out, pumped_in};
}

void Junction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r[0] += holding * (pressure(state) - state.memory()[0]);
}

void Junction::add_tangent(const LocalState& /*state*/, LocalTangent& tangent) const {
  if (tangent.wants_K) tangent.K.dense()(0, 0) += holding;
}

void Junction::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const double p = pressure(state);
  const Range range = balance_range();
  if (p < range.least || p > range.most)  // its net outflow grows with its pressure
    throw ComputationError(fmt::format("t = {:.6g} s: the junction '{}' has no pressure: {}", state.time(), name(),
                                       p < range.least ? range.when_below : range.when_beyond));
  memory[0] = p;
}

void Junction::add_pattern(const Slots& /*slots*/, LocalPattern& pattern) const { pattern.add_diagonal(0, 0, 1); }

std::vector<OutputField> Junction::output_fields() const { return {pressure_field(fluid())}; }

void Junction::describe(const LocalState& /*state*/, Description& description) const {
  description.add("lines meet without volume");
}

void PressureSource::read(const YamlValue& formula, Model& model) {
  formula_ = read_state_formula(formula, {"t"}, model, references_);
  if (formula_.is_constant() && !formula_.reads_state()) warn_of_pressure(formula, formula.number(), fluid());
}

void PressureSource::declare(Declaration& declaration) const {
  references_.declare(declaration);
  Declaration::Scalar flow{"flow", "m^3/s", 0};
  flow.scale = 1e-6;
  flow.algebraic = true;
  flow.equation_units = "m^3/s";
  declaration.first_order = {pressure_unknown(fluid().ambient), flow};
  declaration.stiffness = true;
  declaration.damping = formula_.reads_state();
  declaration.reads_reactions = formula_.reads_reactions();
}

double PressureSource::given(const LocalState& state) const {
  const double t = state.time();
  const double p = formula_.value(state, {&t, 1});
  if (p <= fluid().vacuum())
    throw ComputationError(
        fmt::format("t = {:.6g} s: the pressure of '{}' is given as {:.6g} Pa: expected more than {:.6g} Pa, "
                    "which is vacuum",
                    t, name(), p, fluid().vacuum()));
  return p;
}

void PressureSource::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r[0] += pressure(state) - given(state);
  r[1] += state.first_order()[1];
}

void PressureSource::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) {
    tangent.K.dense()(0, 0) += 1;
    tangent.K.dense()(1, 1) += 1;
  }
  if (!formula_.reads_state()) return;
  Nested<FormulaGradient> gradient;
  const double t = state.time();
  formula_.calc(state, {&t, 1}, *gradient);
  if (tangent.wants_K) tangent.K.dense().row(0) -= gradient->by_state.position().transpose();
  if (tangent.wants_C) tangent.C.dense().row(0) -= gradient->by_state.rate().transpose();
}

double PressureSource::power(const LocalState& state) const {
  return -state.first_order()[1] * fluid().head(pressure(state)).e;
}

void PressureSource::add_energy(const LocalState& state, Energy& energy) const { energy.input += power(state); }

std::vector<OutputField> PressureSource::output_fields() const {
  return {pressure_field(fluid()),
          {"flow", {}, "m^3/s", "net flow of lines into it"},
          {"power", {}, "W", "that it puts into the circuit"}};
}

void PressureSource::write_output(const LocalState& state, double* values) const {
  values[0] = pressure(state);
  values[1] = state.first_order()[1];
  values[2] = power(state);
}

void PressureSource::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("pressure {} [Pa]", formula_.text()));
}

}  // namespace bielle::mechanism
