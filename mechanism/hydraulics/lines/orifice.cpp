#include "mechanism/hydraulics/lines/orifice.hpp"

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Adds the derivatives of a formula by the state, times a factor.
void add_by_formula(double factor, FormulaGradient& gradient, FlowDerivatives& flow) {
  flow.by.position() += factor * gradient.by_state.position();
  flow.by.rate() += factor * gradient.by_state.rate();
}

}  // namespace

// -- orifice

Orifice::Orifice(std::string name, const PressureNode& from, const PressureNode& to, const OrificeLaw& law, double area)
    : Line("orifice", std::move(name)), law_(law), area_(area) {
  const int a = add_port(from), b = add_port(to);
  add_path(a, b);
}

void Orifice::read_area_formula(const YamlValue& formula, Model& model) {
  area_ = read_state_formula(formula, {"t"}, model, references());
}

void Orifice::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  const double t = state.time();
  Nested<FormulaGradient> gradient;
  area_.calc(state, {&t, 1}, *gradient);
  const double area = gradient->value;
  if (area < 0)
    throw ComputationError(
        fmt::format("t = {:.6g} s: the area of orifice '{}' is {:.4g} m^2: expected none below 0", t, name(), area));
  const OrificeLaw::Flow law = law_.calc(area, ports().pressure(state, 0) - ports().pressure(state, 1));
  flow.Q = law.Q;
  add_by_pressure(state, 0, law.Q_D, flow);
  add_by_pressure(state, 1, -law.Q_D, flow);
  if (area_.reads_state()) add_by_formula(law.Q_A, *gradient, flow);
}

std::string Orifice::describe_law() const { return fmt::format("area {} [m^2], {}", area_.text(), law_.describe()); }

// -- leakage

Leakage::Leakage(std::string name, const PressureNode& from, const PressureNode* to, double conductance)
    : Line("laminar", std::move(name)), conductance_(conductance) {
  const int a = add_port(from), b = to ? add_port(*to) : Ports::outside;
  add_path(a, b);
}

void Leakage::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  const bool inside = ports().count() == 2;
  const double back = inside ? ports().pressure(state, 1) : ports().node(0).fluid().ambient;
  flow.Q = conductance_ * (ports().pressure(state, 0) - back);
  add_by_pressure(state, 0, conductance_, flow);
  if (inside) add_by_pressure(state, 1, -conductance_, flow);
}

std::string Leakage::describe_law() const { return fmt::format("laminar, {:.6g} m^3/(s Pa)", conductance_); }

// -- flow source

FlowSource::FlowSource(std::string name, const PressureNode* from, const PressureNode& to)
    : Line("flow_source", std::move(name)) {
  const int a = from ? add_port(*from) : Ports::outside, b = add_port(to);
  add_path(a, b);
}

void FlowSource::read(const YamlValue& formula, Model& model) {
  formula_ = read_state_formula(formula, {"t"}, model, references());
}

void FlowSource::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  const double t = state.time();
  Nested<FormulaGradient> gradient;
  formula_.calc(state, {&t, 1}, *gradient);
  flow.Q = gradient->value;
  if (formula_.reads_state()) add_by_formula(1, *gradient, flow);
}

void FlowSource::add_energy(const LocalState& state, Energy& energy) const {
  energy.input -= ports().power(state, paths()[0].from, paths()[0].to, flow(state, 0));
}

std::string FlowSource::describe_law() const { return fmt::format("flow {} [m^3/s]", formula_.text()); }

}  // namespace bielle::mechanism
