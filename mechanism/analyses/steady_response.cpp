#include "mechanism/analyses/steady_response.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/measures/delayed_measure.hpp"
#include "mechanism/measures/input_measure.hpp"

namespace bielle::mechanism {
namespace {

using Complex = LinearResponse::Complex;

template <class Kind>
const Kind* measure_named(const Model& model, const std::string& name) {
  for (const Component* component : model.components_of({Section::measures, name}))
    if (const auto* measure = dynamic_cast<const Kind*>(component)) return measure;
  return nullptr;
}

const Measure& measure_of(const Model& model, const ResponseOutput& output) {
  return output.measure ? *output.measure : *measure_named<Measure>(model, output.name);
}

}  // namespace

VectorX SteadyResponse::right_side(const ResponseInput& input) const {
  VectorX all = VectorX::Zero(system_.size());
  if (input.node >= 0) {
    const auto k = static_cast<std::size_t>(input.node);
    VectorX forces = VectorX::Zero(system_.kinematics().force_rows());
    const int row = system_.kinematics().force_row(input.node);
    if (input.moment)
      forces.segment<3>(row + 3) = -state_.nodes[k].R.transpose() * input.direction;
    else
      forces.segment<3>(row) = -input.direction;
    system_.kinematics().carry_forces(state_.nodes, forces);
    system_.kinematics().reduce_forces(forces, all.head(system_.kinematics().unknowns()));
  } else {
    const InputStep step = step_of(input);
    VectorX other(system_.size());
    system_.residual(with(step, 1), environment_, all);
    system_.residual(with(step, -1), environment_, other);
    all = (all - other) / (2 * step.size);
  }
  const int n = equations_.unknowns();
  VectorX right(n + equations_.constraints());
  right.head(n) = all.head(n);
  for (int k = 0; k < equations_.constraints(); ++k)
    right[n + k] = all[n + equations_.multiplier[static_cast<std::size_t>(k)]];
  return right;
}

Eigen::VectorXcd SteadyResponse::values(const std::vector<ResponseOutput>& outputs, const LinearMotion& motion) const {
  Variation variation{motion.u, motion.rate, Eigen::VectorXcd::Zero(system_.multipliers())};
  for (int k = 0; k < equations_.constraints(); ++k)
    variation.multiplier[equations_.multiplier[static_cast<std::size_t>(k)]] = motion.multiplier[k];
  Eigen::VectorXcd values(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) values[static_cast<Eigen::Index>(i)] = value(outputs[i], variation);
  return values;
}

Complex SteadyResponse::value(const ResponseOutput& output, const Variation& variation) const {
  if (output.node >= 0) {
    const NodeVariation node = node_variation(system_, state_, variation, output.node);
    const Matrix3& R = state_.nodes[static_cast<std::size_t>(output.node)].R;
    const Eigen::Vector3cd moved =
        output.rotation ? Eigen::Vector3cd(R * node.position.tail<3>()) : Eigen::Vector3cd(node.position.head<3>());
    return output.direction.cast<Complex>().dot(moved);
  }
  const Measure& measure = measure_of(system_.model(), output);
  const Slots& slots = system_.slots_of(measure);
  MeasureGradient gradient;
  measure.calc(LocalState(state_, slots, environment_), gradient);
  const LocalVariation local = local_variation(system_, state_, variation, slots);
  const VectorX by_position = gradient.position(), by_rate = gradient.rate();
  return by_position.cast<Complex>().dot(local.position) + by_rate.cast<Complex>().dot(local.rate);
}

double SteadyResponse::direct(const ResponseOutput& output, const ResponseInput& input) const {
  if (output.node >= 0 || input.node >= 0) return 0;
  const Measure& measure = measure_of(system_.model(), output);
  const Slots& slots = system_.slots_of(measure);
  const InputStep step = step_of(input);
  const State ahead = with(step, 1), behind = with(step, -1);
  return (measure.value(LocalState(ahead, slots, environment_)) -
          measure.value(LocalState(behind, slots, environment_))) /
         (2 * step.size);
}

std::string SteadyResponse::units(const ResponseOutput& output) const {
  if (output.node >= 0) return output.rotation ? "rad" : "m";
  return measure_of(system_.model(), output).units();
}

SteadyResponse::InputStep SteadyResponse::step_of(const ResponseInput& input) const {
  const int place = input.delay
                        ? system_.slots_of(*input.delay).memory_begin + DelayedMeasure::disturbance
                        : system_.slots_of(*measure_named<InputMeasure>(system_.model(), input.name)).memory_begin;
  return {place, 1e-4 * std::max(1.0, std::abs(state_.memory[place]))};
}

State SteadyResponse::with(const InputStep& step, double steps) const {
  State state = state_;
  state.memory[step.place] += steps * step.size;
  return state;
}

}  // namespace bielle::mechanism
