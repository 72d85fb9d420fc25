#include "mechanism/hydraulics/actuators/machine.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

Machine::Machine(std::string name, const Joint& joint, std::size_t coordinate, const PressureNode& from,
                 const PressureNode& to, const Data& data)
    : CoordinateAction("machine", std::move(name), joint, coordinate), data_(data) {
  ports_.add(from, references());
  ports_.add(to, references());
}

void Machine::read_setting(const YamlValue& formula, Model& model) {
  setting_ = read_state_formula(formula, {"t"}, model, references());
}

void Machine::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = true;
  declaration.reads_reactions = setting_.reads_reactions();
}

double Machine::setting(const LocalState& state) const {
  const double t = state.time();
  return setting_.value(state, {&t, 1});
}

double Machine::flow(const LocalState& state, double x, double rate) const {
  return x * data_.displacement * rate + data_.leakage * (ports_.pressure(state, 0) - ports_.pressure(state, 1));
}

double Machine::torque(const LocalState& state, double x, double rate) const {
  return x * data_.displacement * (ports_.head(state, 0) - ports_.head(state, 1)) - data_.drag * rate;
}

void Machine::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateJet& jet = calc(state);
  const double x = setting(state);
  r.segment(row(state), jet.w().size()) -= torque(state, x, jet.rate) * jet.w();
  ports_.add_flow(state, 0, 1, flow(state, x, jet.rate), r);
}

void Machine::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  thread_local FlowJet jet_of_flow;
  thread_local FormulaGradient of_setting;
  const double t = state.time(), D = data_.displacement;
  setting_.calc(state, {&t, 1}, of_setting);
  const double x = of_setting.value;
  CoordinateJet& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  const VectorX& slope = rate_slope(state, jet);

  jet_of_flow.prepare(state.slots().size());
  jet_of_flow.Q = flow(state, x, jet.rate);
  jet_of_flow.by.position().segment(at, n) += x * D * slope;
  jet_of_flow.by.rate().segment(at, n) += x * D * jet.w();
  for (const int port : {0, 1})
    jet_of_flow.by.position()[ports_.pressure_row(state, port)] += (port == 0 ? 1 : -1) * data_.leakage;
  if (setting_.reads_state()) {
    jet_of_flow.by.position() += D * jet.rate * of_setting.by_state.position();
    jet_of_flow.by.rate() += D * jet.rate * of_setting.by_state.rate();
  }
  ports_.add_tangent(state, 0, 1, jet_of_flow, tangent);

  const double difference = ports_.head(state, 0) - ports_.head(state, 1);
  if (tangent.wants_C) tangent.C.dense().block(at, at, n, n) += data_.drag * jet.w() * jet.w().transpose();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.block(at, at, n, n) -= torque(state, x, jet.rate) * jet.W();
    K.block(at, at, n, n) += data_.drag * jet.w() * slope.transpose();
    for (const int port : {0, 1}) {
      const double e_p = ports_.node(port).fluid().head(ports_.pressure(state, port)).e_p;
      K.col(ports_.pressure_row(state, port)).segment(at, n) -= (port == 0 ? 1 : -1) * x * D * e_p * jet.w();
    }
  }
  if (!setting_.reads_state()) return;
  if (tangent.wants_K)
    tangent.K.dense().middleRows(at, n) -= D * difference * jet.w() * of_setting.by_state.position().transpose();
  if (tangent.wants_C)
    tangent.C.dense().middleRows(at, n) -= D * difference * jet.w() * of_setting.by_state.rate().transpose();
}

void Machine::add_energy(const LocalState& state, Energy& energy) const {
  const double rate = value(state).rate;
  energy.dissipation +=
      data_.drag * rate * rate +
      ports_.power(state, 0, 1, data_.leakage * (ports_.pressure(state, 0) - ports_.pressure(state, 1)));
}

std::vector<OutputField> Machine::output_fields() const {
  return {{"flow", {}, "m^3/s", ports_.describe(0, 1)},
          {"torque", {}, coordinate().force_units(), "on the coordinate of the joint"},
          {"power", {}, "W", "that it gives to the shaft"}};
}

void Machine::write_output(const LocalState& state, double* values) const {
  const double rate = value(state).rate, x = setting(state);
  values[0] = flow(state, x, rate);
  values[1] = torque(state, x, rate);
  values[2] = values[1] * rate;
}

void Machine::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("{} of joint '{}', {}, {:.6g} m^3/{}", coordinate().name, joint().name(),
                              ports_.describe(0, 1), data_.displacement, coordinate().units()));
  if (!setting_.is_constant()) description.add(fmt::format("setting {}", setting_.text()));
}

}  // namespace bielle::mechanism
