#include "mechanism/hydraulics/circuit/accumulator.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

/// "store.fluid_volume"
class AccumulatorMeasure final : public OwnMeasure {
 public:
  AccumulatorMeasure(std::string name, const Accumulator& accumulator)
      : OwnMeasure(std::move(name), accumulator), accumulator_(accumulator) {}
  std::string units() const override { return "m^3"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    const Accumulator::Space space = accumulator_.space(own);
    gradient.position()[own.slots().reference_row(0) + Volume::pressure_row] = space.V_p;
    return space.V;
  }
  const Accumulator& accumulator_;
};

Accumulator::Accumulator(std::string name, Volume& volume, double gas_volume, double precharge, double exponent)
    : Component("accumulator", std::move(name)),
      volume_(volume),
      gas_volume_(gas_volume),
      precharge_(precharge),
      exponent_(exponent) {
  references_.add(volume);
  volume.add_room([this](double p) { return space(p, side_of(p)).V; });
}

void Accumulator::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  declaration.memory = {undecided};
  if (gas_volume_ > 0) declaration.event_functions = {{"passes its precharge"}};
}

double Accumulator::side(const LocalState& state) const {
  const double kept = state.memory()[0];
  return state.environment().statics || kept == undecided ? side_of(pressure(state)) : kept;
}

Accumulator::Space Accumulator::space(double p, double side) const {
  if (side == empty) return {};
  const double P0 = absolute(precharge_), P = absolute(p), n = exponent_, V0 = gas_volume_;
  if (p < precharge_) {  // the gas law is continued by its tangent
    const double V_p = V0 / (n * P0);
    return {V_p * (p - precharge_), V_p, 0.5 * V_p * (P * P - P0 * P0)};
  }
  const double gas = std::pow(P0 / P, 1 / n);
  return {V0 * (1 - gas), V0 * gas / (n * P),
          n == 1 ? P0 * V0 * std::log(P / P0) : P0 * V0 / (n - 1) * (std::pow(P / P0, (n - 1) / n) - 1)};
}

void Accumulator::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r[state.slots().reference_row(0) + Volume::space_row] -= space(state).V;
}

void Accumulator::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const int row = state.slots().reference_row(0);
  tangent.K.dense()(row + Volume::space_row, row + Volume::pressure_row) -= space(state).V_p;
}

void Accumulator::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  const int row = slots.reference_row(0);
  pattern.add_block(row + Volume::space_row, row + Volume::pressure_row, 1, 1);
}

// The work of the gas from its precharge on, minus that of the ambient pressure.
void Accumulator::add_energy(const LocalState& state, Energy& energy) const {
  const Space now = space(state);
  energy.elastic += now.work - absolute(volume_.fluid().ambient) * now.V;
}

// A filled accumulator becomes empty a little below the precharge. The pressure that follows from the equations of the
// new side is then on this side in spite of rounding errors.
double Accumulator::way_to_empty(const LocalState& state) const {
  constexpr double margin = 1e-8;
  return pressure(state) - precharge_ + (state.memory()[0] == empty ? 0 : margin * absolute(precharge_));
}

void Accumulator::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (values.size() > 0) values[0] = way_to_empty(state);
}

void Accumulator::begin_branch(const LocalState& state, std::span<const int> crossed,
                               Eigen::Ref<VectorX> memory) const {
  if (memory[0] == undecided) return;  // the pressure at the start is not known yet
  if (!crossed.empty())
    memory[0] = side_of(pressure(state));
  else if (leaves_branch(state))
    memory[0] = memory[0] == empty ? filled : empty;
}

void Accumulator::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (memory[0] == undecided || state.environment().statics) memory[0] = side_of(pressure(state));
}

bool Accumulator::leaves_branch(const LocalState& state) const {
  const double kept = state.memory()[0], way = way_to_empty(state);
  return (kept == empty && way > 0) || (kept == filled && way < 0);
}

bool Accumulator::knows_memory(const LocalState& state) const {
  const double kept = state.memory()[0];
  return kept == empty || kept == filled || kept == undecided;
}

std::vector<OutputField> Accumulator::output_fields() const {
  return {{"pressure", {}, "Pa", "of the fluid"}, {"fluid_volume", {}, "m^3", "fluid in it"}};
}

void Accumulator::write_output(const LocalState& state, double* values) const {
  values[0] = pressure(state);
  values[1] = space(state).V;
}

void Accumulator::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("at '{}', {:.6g} m^3 of gas at {:.6g} Pa, exponent {:.6g}", volume_.name(), gas_volume_,
                              precharge_, exponent_));
}

std::unique_ptr<Measure> Accumulator::make_measure(const std::string& name, const std::string& /*measure*/) const {
  return std::make_unique<AccumulatorMeasure>(name, *this);
}

}  // namespace bielle::mechanism
