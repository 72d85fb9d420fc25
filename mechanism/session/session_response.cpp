// Frequency responses about the state that a session shows.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/measures/input_measure.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/linearised/variations.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

template <class Kind>
const Kind* measure_named(const Model& model, const std::string& name) {
  for (const Component* component : model.components_of({Section::measures, name}))
    if (const auto* measure = dynamic_cast<const Kind*>(component)) return measure;
  return nullptr;
}

template <class Kind>
std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const Member& member : model.members())
    if (dynamic_cast<const Kind*>(member.component.get())) names.push_back(member.entry.name);
  return names;
}

/// Inputs of the model act through the forces that formulas make of them: central differences, exact where these are
/// linear in them.
struct InputStep {
  int place;  ///< in the state's memory
  double size;
};

class Response {
 public:
  Response(const System& system, const StandingState& about, const LinearisedEquations& equations)
      : system_(system), state_(about.state), environment_(about.environment), equations_(equations) {}

  /// dr of a unit of the input (n + constraints).
  VectorX right_side(const ResponseInput& input) const {
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
      const InputStep step = step_of(input.name);
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

  Variation answer(const ShiftedOperator& D, const VectorX& right) const {
    const int n = equations_.unknowns();
    const Eigen::VectorXcd solution = D.solve(-right.cast<Complex>());
    Variation variation{solution.head(n), {}, Eigen::VectorXcd::Zero(system_.multipliers())};
    variation.rate = D.shift() * variation.u + equations_.W * variation.u;
    for (int k = 0; k < equations_.constraints(); ++k)
      variation.multiplier[equations_.multiplier[static_cast<std::size_t>(k)]] = solution[n + k];
    return variation;
  }

  Complex value(const ResponseOutput& output, const ResponseInput& input, const Variation& variation) const {
    if (output.node >= 0) {
      const NodeVariation node = node_variation(system_, state_, variation, output.node);
      const Matrix3& R = state_.nodes[static_cast<std::size_t>(output.node)].R;
      const Eigen::Vector3cd moved =
          output.rotation ? Eigen::Vector3cd(R * node.position.tail<3>()) : Eigen::Vector3cd(node.position.head<3>());
      return output.direction.cast<Complex>().dot(moved);
    }
    const Measure& measure = *measure_named<Measure>(system_.model(), output.name);
    const Slots& slots = system_.slots_of(measure);
    MeasureGradient gradient;
    measure.calc(LocalState(state_, slots, environment_), gradient);
    const LocalVariation local = local_variation(system_, state_, variation, slots);
    const VectorX by_position = gradient.position(), by_rate = gradient.rate();
    Complex sum = by_position.cast<Complex>().dot(local.position) + by_rate.cast<Complex>().dot(local.rate);
    if (input.node < 0) {  // of which it may be a function itself
      const InputStep step = step_of(input.name);
      const State ahead = with(step, 1), behind = with(step, -1);
      sum += (measure.value(LocalState(ahead, slots, environment_)) -
              measure.value(LocalState(behind, slots, environment_))) /
             (2 * step.size);
    }
    return sum;
  }

 private:
  InputStep step_of(const std::string& name) const {
    const int place = system_.slots_of(*measure_named<InputMeasure>(system_.model(), name)).memory_begin;
    return {place, 1e-4 * std::max(1.0, std::abs(state_.memory[place]))};
  }
  State with(const InputStep& step, double steps) const {
    State state = state_;
    state.memory[step.place] += steps * step.size;
    return state;
  }

  const System& system_;
  const State& state_;
  const Environment& environment_;
  const LinearisedEquations& equations_;
};

template <class Kind>
void check_named(const Model& model, const std::string& name, const char* what) {
  if (measure_named<Kind>(model, name)) return;
  throw InputError(fmt::format("there is no {} '{}'{}", what, name, did_you_mean(name, names_of<Kind>(model))));
}

}  // namespace

FrequencyResponse Session::frequency_response(const FrequencyResponseOptions& options) const {
  for (const ResponseInput& input : options.inputs)
    if (input.node < 0) check_named<InputMeasure>(model_, input.name, "input");
  for (const ResponseOutput& output : options.outputs)
    if (output.node < 0) check_named<Measure>(model_, output.name, "measure");
  StandingState about = standing();
  if (options.rotation) settle_in_rotation(system_, about.environment, *options.rotation, about.state);
  FrequencyResponse result;
  if (const auto steadiness = find_steadiness(system_, about.environment, about.state))
    result.axes = steadiness->axes();
  const LinearisedEquations equations = linearised_equations(system_, about.environment, about.state, result.axes);
  const Response response(system_, about, equations);
  std::vector<VectorX> rights;
  for (const ResponseInput& input : options.inputs) rights.push_back(response.right_side(input));
  for (const ResponseOutput& output : options.outputs)
    result.output_units.push_back(output.node >= 0 ? (output.rotation ? "rad" : "m")
                                                   : measure_named<Measure>(model_, output.name)->units());
  for (const double frequency : options.frequencies) {
    const ShiftedOperator D(equations, Complex(0, 2 * std::numbers::pi * frequency));
    if (!D.regular())
      throw ComputationError(fmt::format(
          "there is no response at {:.6g} Hz: it is a frequency at which the mechanism moves without any force",
          frequency));
    Eigen::MatrixXcd H(options.outputs.size(), options.inputs.size());
    for (std::size_t j = 0; j < rights.size(); ++j) {
      const Variation variation = response.answer(D, rights[j]);
      for (std::size_t i = 0; i < options.outputs.size(); ++i)
        H(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            response.value(options.outputs[i], options.inputs[j], variation);
    }
    result.response.push_back(std::move(H));
  }
  return result;
}

}  // namespace bielle::mechanism
