#include "mechanism/hydraulics/lines/pressure_valve.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/hydraulics/lines/opening.hpp"
#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

// -- poppets

PoppetValve::PoppetValve(std::string type, std::string name, const PressureNode& from, const PressureNode& to,
                         const PressureNode* pilot, const OrificeLaw& law, const Setting& setting)
    : Line(std::move(type), std::move(name)), law_(law), setting_(setting) {
  const int a = add_port(from), b = add_port(to);
  if (pilot) add_port(*pilot);
  add_path(a, b);
}

void PoppetValve::declare(Declaration& declaration) const {
  Line::declare(declaration);
  declaration.memory = OpeningLock::start_memory();
  if (!follows()) return;
  declaration.damping = true;
  declaration.starts_by_state = true;
  Declaration::Scalar opening{"opening", "-", 0};
  opening.scale = 1;
  opening.equation_units = "1/s";
  declaration.first_order = {opening};
}

double PoppetValve::wanted(const LocalState& state, MeasureGradient& gradient) const {
  const double ambient = ports().node(0).fluid().ambient;
  const auto over = [&](int port) { return ports().pressure(state, port) - ambient; };
  double x = over(0) - setting_.back * over(1) - setting_.pressure;
  if (setting_.pilot_ratio > 0) x += setting_.pilot_ratio * over(2);
  const Opening open = poppet_opening(x / setting_.range);
  auto by = gradient.position();
  const double slope = open.slope / setting_.range;
  by[ports().pressure_row(state, 0)] += slope;
  by[ports().pressure_row(state, 1)] -= slope * setting_.back;
  if (setting_.pilot_ratio > 0) by[ports().pressure_row(state, 2)] += slope * setting_.pilot_ratio;
  return open.value;
}

// At the start of a motion and in statics, which both determine pressures and opening together, a valve with a time
// constant has the opening that corresponds to its pressures.
double PoppetValve::opening(const LocalState& state, MeasureGradient& gradient) const {
  if (OpeningLock::is_locked(state)) return OpeningLock::kept_opening(state);
  if (!follows() || state.environment().statics || state.memory()[OpeningLock::begun] == 0)
    return wanted(state, gradient);
  gradient.position()[state.slots().first_order_row()] += 1;
  return state.first_order()[0];
}

void PoppetValve::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  thread_local MeasureGradient of_opening;
  of_opening.prepare(state.slots().size());
  double open = opening(state, of_opening);
  const double D = ports().pressure(state, 0) - ports().pressure(state, 1);
  if (setting_.check_pressure >= 0) {
    // The check valve opens the same seat from the other side.
    const Opening back = poppet_opening((-D - setting_.check_pressure) / setting_.range);
    open += back.value;
    of_opening.position()[ports().pressure_row(state, 0)] -= back.slope / setting_.range;
    of_opening.position()[ports().pressure_row(state, 1)] += back.slope / setting_.range;
  }
  if (!(open > 0)) return;  // an opening with a time constant may become negative by its error
  const OrificeLaw::Flow law = law_.calc(setting_.area * open, D);
  flow.Q = law.Q;
  flow.by.position() += law.Q_A * setting_.area * of_opening.position();
  add_by_pressure(state, 0, law.Q_D, flow);
  add_by_pressure(state, 1, -law.Q_D, flow);
}

void PoppetValve::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Line::add_residual(state, r);
  if (!follows()) return;
  double& rate = r[state.slots().first_order_row()];
  rate += state.first_order_rate()[0];
  if (OpeningLock::is_locked(state)) return;
  thread_local MeasureGradient unused;
  unused.prepare(state.slots().size());
  rate -= (wanted(state, unused) - state.first_order()[0]) / setting_.time_constant;
}

void PoppetValve::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Line::add_tangent(state, tangent);
  if (!follows()) return;
  const int row = state.slots().first_order_row();
  if (tangent.wants_C) tangent.C.dense()(row, row) += 1;
  if (!tangent.wants_K) return;
  if (OpeningLock::is_locked(state)) {
    if (state.environment().statics) tangent.K.dense()(row, row) += 1;  // the increment is zero
    return;
  }
  thread_local MeasureGradient of_wanted;
  of_wanted.prepare(state.slots().size());
  wanted(state, of_wanted);
  auto K = tangent.K.dense();
  K(row, row) += 1 / setting_.time_constant;
  K.row(row) -= of_wanted.position().transpose() / setting_.time_constant;
}

void PoppetValve::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  Line::add_pattern(slots, pattern);
  if (follows()) pattern.add_block(slots.first_order_row(), 0, 1, slots.size());
}

void PoppetValve::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  if (!follows() || state.memory()[OpeningLock::begun] != 0) return;
  Nested<MeasureGradient> unused;
  unused->prepare(state.slots().size());
  change[state.slots().first_order_row()] += wanted(state, *unused) - state.first_order()[0];
}

void PoppetValve::accept(const LocalState& /*state*/, Eigen::Ref<VectorX> memory) const {
  memory[OpeningLock::begun] = 1;
}

void PoppetValve::begin_branch(const LocalState& /*state*/, std::span<const int> /*crossed*/,
                               Eigen::Ref<VectorX> memory) const {
  OpeningLock::follow(0, memory);
}

double PoppetValve::present_value(const LocalState& state) const {
  Nested<MeasureGradient> unused;
  unused->prepare(state.slots().size());
  return opening(state, *unused);
}

std::vector<OutputField> PoppetValve::own_fields() const { return {{"opening", {}, "-", "share of the full opening"}}; }

void PoppetValve::write_own(const LocalState& state, double* values) const { values[0] = present_value(state); }

double PoppetValve::calc_own_measure(const LocalState& state, const std::string& /*measure*/,
                                     MeasureGradient& gradient) const {
  return opening(state, gradient);
}

std::string PoppetValve::describe_law() const {
  std::string text =
      fmt::format("opens from {:.6g} to {:.6g} Pa", setting_.pressure, setting_.pressure + setting_.range);
  if (setting_.pilot_ratio > 0) text += fmt::format(", pilot ratio {:.6g}", setting_.pilot_ratio);
  if (setting_.check_pressure >= 0) text += fmt::format(", back from {:.6g} Pa", setting_.check_pressure);
  if (follows()) text += fmt::format(", follows with {:.6g} s", setting_.time_constant);
  return text + fmt::format(", area {:.6g} m^2, {}", setting_.area, law_.describe());
}

// -- flow valve

FlowValve::FlowValve(std::string name, const PressureNode& from, const PressureNode& to, double pressure)
    : Line("flow_valve", std::move(name)), pressure_(pressure) {
  const int a = add_port(from), b = add_port(to);
  add_path(a, b);
}

void FlowValve::read(const YamlValue& formula, Model& model) {
  formula_ = read_state_formula(formula, {"t"}, model, references());
}

void FlowValve::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  const double t = state.time();
  Nested<FormulaGradient> set;
  formula_.calc(state, {&t, 1}, *set);
  if (set->value < 0)
    throw ComputationError(
        fmt::format("t = {:.6g} s: flow valve '{}' is set to {:.4g} m^3/s: expected no flow below 0; "
                    "exchange `from` and `to`",
                    t, name(), set->value));
  const double x = (ports().pressure(state, 0) - ports().pressure(state, 1)) / pressure_;
  // The orifice law g = x/(x^2 + e^2)^(1/4) with a narrow laminar range, with a limited pressure for x > 0.
  constexpr double e = 0.01;
  double limited = x, slope = 1;
  if (x > 0) {
    const double x8 = std::pow(x, 8), root = std::pow(1 + x8, 0.125);
    limited = x / root;
    slope = 1 / (root * (1 + x8));
  }
  const double s = limited * limited + e * e, quarter = std::sqrt(std::sqrt(s));
  const double g = limited / quarter, g_x = (0.5 * limited * limited + e * e) / (s * quarter) * slope;
  flow.Q = set->value * g;
  add_by_pressure(state, 0, set->value * g_x / pressure_, flow);
  add_by_pressure(state, 1, -set->value * g_x / pressure_, flow);
  if (!formula_.reads_state()) return;
  flow.by.position() += g * set->by_state.position();
  flow.by.rate() += g * set->by_state.rate();
}

std::string FlowValve::describe_law() const {
  return fmt::format("flow {} [m^3/s] from {:.6g} Pa on", formula_.text(), pressure_);
}

}  // namespace bielle::mechanism
