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
    const Accumulator::Space space = accumulator_.space(accumulator_.volume_.pressure(own.of(0)));
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
  volume.add_room([this](double p) { return space(p).V; });
}

void Accumulator::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  declaration.kinks = true;  // at the precharge pressure
}

Accumulator::Space Accumulator::space(double p) const {
  if (p <= precharge_) return {0, 0};
  const double P = absolute(p), gas = std::pow(absolute(precharge_) / P, 1 / exponent_);
  return {gas_volume_ * (1 - gas), gas_volume_ * gas / (exponent_ * P)};
}

void Accumulator::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r[state.slots().reference_row(0) + Volume::space_row] -= space(volume_.pressure(state.of(0))).V;
}

void Accumulator::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const int row = state.slots().reference_row(0);
  tangent.K.dense()(row + Volume::space_row, row + Volume::pressure_row) -= space(volume_.pressure(state.of(0))).V_p;
}

void Accumulator::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  const int row = slots.reference_row(0);
  pattern.add_block(row + Volume::space_row, row + Volume::pressure_row, 1, 1);
}

// The work of the gas from its precharge on, minus that of the ambient pressure.
void Accumulator::add_energy(const LocalState& state, Energy& energy) const {
  const double p = volume_.pressure(state.of(0));
  if (p <= precharge_) return;
  const double P0 = absolute(precharge_), P = absolute(p), n = exponent_;
  const double gas =
      n == 1 ? P0 * gas_volume_ * std::log(P / P0) : P0 * gas_volume_ / (n - 1) * (std::pow(P / P0, (n - 1) / n) - 1);
  const double outside = absolute(volume_.fluid().ambient);
  energy.elastic += gas - outside * space(p).V;
}

std::vector<OutputField> Accumulator::output_fields() const {
  return {{"pressure", {}, "Pa", "of the fluid"}, {"fluid_volume", {}, "m^3", "fluid in it"}};
}

void Accumulator::write_output(const LocalState& state, double* values) const {
  values[0] = volume_.pressure(state.of(0));
  values[1] = space(values[0]).V;
}

void Accumulator::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("at '{}', {:.6g} m^3 of gas at {:.6g} Pa, exponent {:.6g}", volume_.name(), gas_volume_,
                              precharge_, exponent_));
}

std::unique_ptr<Measure> Accumulator::make_measure(const std::string& name, const std::string& /*measure*/) const {
  return std::make_unique<AccumulatorMeasure>(name, *this);
}

}  // namespace bielle::mechanism
