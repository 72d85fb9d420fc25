#include "mechanism/hydraulics/actuators/machine.hpp"

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

/// "winch.flow", "winch.torque", "winch.power"
class MachineMeasure final : public OwnMeasure {
 public:
  MachineMeasure(std::string name, const Machine& machine, std::string quantity)
      : OwnMeasure(std::move(name), machine), machine_(machine), quantity_(std::move(quantity)) {}
  std::string units() const override {
    return quantity_ == "flow" ? "m^3/s" : quantity_ == "power" ? "W" : machine_.coordinate().force_units();
  }
  bool reads_reactions() const override { return machine_.setting_.reads_reactions(); }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    Nested<FlowDerivatives> jet;
    Nested<FormulaGradient> of_setting;
    const Machine::Turn turn = machine_.turn(own, *of_setting);
    jet->prepare(own.slots().size());
    quantity_ == "flow" ? machine_.calc_flow(own, turn, *jet) : machine_.calc_torque(own, turn, *jet);
    gradient = jet->by;
    if (quantity_ != "power") return jet->Q;
    gradient.position() *= turn.jet.rate;
    gradient.rate() *= turn.jet.rate;
    const int at = machine_.row(own);
    gradient.position().segment(at, turn.slope.size()) += jet->Q * turn.slope;
    gradient.rate().segment(at, turn.slope.size()) += jet->Q * turn.jet.w();
    return jet->Q * turn.jet.rate;
  }
  const Machine& machine_;
  std::string quantity_;
};

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
  CoordinateDerivatives& jet = calc(state);
  const double x = setting(state);
  r.segment(row(state), jet.w().size()) -= torque(state, x, jet.rate) * jet.w();
  ports_.add_flow(state, 0, 1, flow(state, x, jet.rate), r);
}

Machine::Turn Machine::turn(const LocalState& state, FormulaGradient& setting) const {
  const double t = state.time();
  setting_.calc(state, {&t, 1}, setting);
  CoordinateDerivatives& jet = calc(state);
  return {jet, rate_slope(state, jet), setting};
}

void Machine::calc_flow(const LocalState& state, const Turn& turn, FlowDerivatives& flow) const {
  const double x = turn.setting.value, D = data_.displacement;
  const int at = row(state);
  const auto n = turn.slope.size();
  flow.Q = this->flow(state, x, turn.jet.rate);
  flow.by.position().segment(at, n) += x * D * turn.slope;
  flow.by.rate().segment(at, n) += x * D * turn.jet.w();
  for (const int port : {0, 1})
    flow.by.position()[ports_.pressure_row(state, port)] += (port == 0 ? 1 : -1) * data_.leakage;
  if (!setting_.reads_state()) return;
  flow.by.position() += D * turn.jet.rate * turn.setting.by_state.position();
  flow.by.rate() += D * turn.jet.rate * turn.setting.by_state.rate();
}

void Machine::calc_torque(const LocalState& state, const Turn& turn, FlowDerivatives& torque) const {
  const double x = turn.setting.value, D = data_.displacement;
  const int at = row(state);
  const auto n = turn.slope.size();
  torque.Q = this->torque(state, x, turn.jet.rate);
  torque.by.position().segment(at, n) -= data_.drag * turn.slope;
  torque.by.rate().segment(at, n) -= data_.drag * turn.jet.w();
  for (const int port : {0, 1}) {
    const double e_p = ports_.node(port).fluid().head(ports_.pressure(state, port)).e_p;
    torque.by.position()[ports_.pressure_row(state, port)] += (port == 0 ? 1 : -1) * x * D * e_p;
  }
  if (!setting_.reads_state()) return;
  const double difference = ports_.head(state, 0) - ports_.head(state, 1);
  torque.by.position() += D * difference * turn.setting.by_state.position();
  torque.by.rate() += D * difference * turn.setting.by_state.rate();
}

void Machine::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Nested<FlowDerivatives> jet;
  Nested<FormulaGradient> of_setting;
  const Turn turn = this->turn(state, *of_setting);
  jet->prepare(state.slots().size());
  calc_flow(state, turn, *jet);
  ports_.add_tangent(state, 0, 1, *jet, tangent);
  jet->prepare(state.slots().size());
  calc_torque(state, turn, *jet);
  const int at = row(state);
  const auto n = turn.slope.size();
  if (tangent.wants_C) tangent.C.dense().middleRows(at, n) -= turn.jet.w() * jet->by.rate().transpose();
  if (!tangent.wants_K) return;
  tangent.K.dense().middleRows(at, n) -= turn.jet.w() * jet->by.position().transpose();
  tangent.K.dense().block(at, at, n, n) -= jet->Q * turn.jet.W();
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

std::unique_ptr<Measure> Machine::make_measure(const std::string& name, const std::string& measure) const {
  return std::make_unique<MachineMeasure>(name, *this, measure);
}

}  // namespace bielle::mechanism
