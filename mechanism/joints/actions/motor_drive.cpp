#include "mechanism/joints/actions/motor_drive.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {

MotorDrive::MotorDrive(std::string name, const Joint& joint, std::size_t coordinate, const MotorData& data,
                       const MotorCurrent& current)
    : Drive(std::move(name), joint, coordinate), data_(data), current_(references().add(current)) {}

void MotorDrive::read(const YamlValue& voltage, Model& model) {
  voltage_ = read_state_formula(voltage, {"t"}, model, references());
}

void MotorDrive::declare(Declaration& declaration) const {
  declare_drive(declaration);
  declaration.damping = true;
  declaration.reads_reactions = voltage_.reads_reactions();
}

double MotorDrive::voltage(const LocalState& state) const {
  const double t = state.time();
  return voltage_.value(state, {&t, 1});
}

double MotorDrive::force(const LocalState& state) const {
  if (released(state)) return 0;
  const double n = data_.gear_ratio;
  double torque = n * data_.torque_constant * current(state);
  if (data_.friction > 0) torque -= n * n * data_.friction * value(state).rate;
  return state.environment().load_factor * torque;
}

void MotorDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Drive::add_residual(state, r);
  const double drop = data_.resistance * current(state) + back_emf(state) * value(state).rate - voltage(state);
  double& equation = r[current_row(state)];
  equation += drop / divisor();
  if (data_.inductance > 0) equation += state.of(current_).first_order_rate()[0];
}

void MotorDrive::add_force_tangent(const LocalState& state, CoordinateDerivatives& jet, LocalTangent& tangent) const {
  const double s = state.environment().load_factor, n = data_.gear_ratio, drag = s * n * n * data_.friction;
  const int at = row(state);
  const auto size = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.block(at, at, size, size) -= force(state) * jet.W();
    K.block(at, current_row(state), size, 1) -= s * n * data_.torque_constant * jet.w();
    if (drag > 0) K.block(at, at, size, size) += drag * jet.w() * rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C && drag > 0) tangent.C.dense().block(at, at, size, size) += drag * jet.w() * jet.w().transpose();
}

void MotorDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const int equation = current_row(state), at = row(state);
  if (!released(state)) {
    CoordinateDerivatives& jet = calc(state);
    const auto size = jet.w().size();
    const double emf = back_emf(state) / divisor();
    add_force_tangent(state, jet, tangent);
    if (tangent.wants_K) tangent.K.dense().row(equation).segment(at, size) += emf * rate_slope(state, jet).transpose();
    if (tangent.wants_C) tangent.C.dense().row(equation).segment(at, size) += emf * jet.w().transpose();
  }
  if (tangent.wants_K) tangent.K.dense()(equation, equation) += data_.resistance / divisor();
  if (tangent.wants_C && data_.inductance > 0) tangent.C.dense()(equation, equation) += 1;
  if (!voltage_.reads_state()) return;
  const double t = state.time();
  thread_local FormulaGradient gradient;
  voltage_.calc(state, {&t, 1}, gradient);
  if (tangent.wants_K) tangent.K.dense().row(equation) -= gradient.by_state.position().transpose() / divisor();
  if (tangent.wants_C) tangent.C.dense().row(equation) -= gradient.by_state.rate().transpose() / divisor();
}

void MotorDrive::add_energy(const LocalState& state, Energy& energy) const {
  const double i = current(state), rate = value(state).rate, n = data_.gear_ratio;
  energy.input += voltage(state) * i;
  energy.dissipation += data_.resistance * i * i;
  energy.elastic += data_.inductance * i * i / 2;
  if (released(state)) return;
  energy.input += (data_.torque_constant - data_.back_emf) * n * rate * i;
  energy.dissipation += n * n * data_.friction * rate * rate;
}

double MotorDrive::calc_power(const LocalState& state, MeasureGradient& gradient) const {
  const double t = state.time(), i = current(state);
  FormulaGradient of_voltage;  // a measure may depend on other measures: the buffer must not be shared
  voltage_.calc(state, {&t, 1}, of_voltage);
  if (voltage_.reads_state()) {
    gradient.position() += i * of_voltage.by_state.position();
    gradient.rate() += i * of_voltage.by_state.rate();
  }
  gradient.position()[current_row(state)] += of_voltage.value;
  return of_voltage.value * i;
}

Drive::LawText MotorDrive::law_text() const {
  const bool turning = coordinate().kind != JointCoordinate::Kind::displacement;
  std::string law = fmt::format("of a motor at {} V, {:.6g} Ohm, {:.6g} H, {:.6g} {}/A", voltage_.text(),
                                data_.resistance, data_.inductance, data_.torque_constant, coordinate().force_units());
  if (data_.back_emf != data_.torque_constant)
    law += fmt::format(", back EMF {:.6g} V s/{}", data_.back_emf, coordinate().units());
  if (data_.gear_ratio != 1) law += fmt::format(", gear ratio {:.6g}", data_.gear_ratio);
  if (data_.friction > 0) law += fmt::format(", friction {:.6g}", data_.friction);
  return {fmt::format("{} on {}", turning ? "torque" : "force", coordinate().name), law, coordinate().force_units()};
}

std::vector<TimeDependent::Formula> MotorDrive::time_formulas() const {
  if (!voltage_.holds_time()) return {};
  return {{"voltage", "V"}};
}

void MotorDrive::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  values[0] = voltage(state);
}

std::unique_ptr<Drive> make_motor(const std::string& name, const YamlValue& entry, const Joint& joint,
                                  std::size_t coordinate, Model& model) {
  MotorData data;
  data.resistance = entry.at("resistance").number();
  data.inductance = entry.at("inductance").number();
  data.torque_constant = entry.at("torque_constant").number();
  data.back_emf = entry.has("back_emf") ? entry.at("back_emf").number() : data.torque_constant;
  data.gear_ratio = entry.at("gear_ratio").number();
  data.friction = entry.at("friction").number();
  for (const char* key : {"torque_constant", "gear_ratio"})
    if (entry.at(key).number() == 0) entry.at(key).fail("is 0: the motor would have no torque");
  const Entry own{Section::drives, name};
  auto& current = static_cast<MotorCurrent&>(
      model.add(std::make_unique<MotorCurrent>(name, data.inductance == 0), own, Recorded::no));
  auto drive = std::make_unique<MotorDrive>(name, joint, coordinate, data, current);
  MotorDrive& motor = *drive;
  const auto announce = [&](const char* quantity, auto make) {
    model.announce_measure(name + "." + quantity, [own, make, &model, full = name + "." + quantity] {
      model.add_measure_of(own, make(full), true);
    });
  };
  const double factor = data.gear_ratio * data.torque_constant;
  const std::string units = joint.coordinates()[coordinate].force_units();
  announce("current", [&current](const std::string& full) -> std::unique_ptr<Measure> {
    return std::make_unique<MotorCurrentMeasure>(full, current, 1, "A");
  });
  announce("torque", [&current, factor, units](const std::string& full) -> std::unique_ptr<Measure> {
    return std::make_unique<MotorCurrentMeasure>(full, current, factor, units);
  });
  announce("power", [&motor](const std::string& full) -> std::unique_ptr<Measure> {
    return std::make_unique<MotorPower>(full, motor);
  });
  model.when_read(Model::Stage::formulas,
                  [&motor, voltage = entry.at("voltage"), &model] { motor.read(voltage, model); });
  return drive;
}

}  // namespace bielle::mechanism
