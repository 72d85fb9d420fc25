// Frequency responses about the state that a session shows.
#include <numbers>

#include <fmt/format.h>

#include "mechanism/session/linear_response.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

FrequencyResponse Session::frequency_response(const FrequencyResponseOptions& options) const {
  check_response_names(model_, options.inputs, options.outputs);
  StandingState about = standing();
  if (options.rotation) settle_in_rotation(system_, about.environment, *options.rotation, about.state);
  FrequencyResponse result;
  static_cast<LinearisedSetting&>(result) = linearised_setting(system_, about.environment, about.state);
  const LinearisedEquations equations = linearised_equations(system_, about.environment, about.state, result.axes);
  const LinearResponse response(system_, about, equations);
  const std::vector<VectorX> rights = response.right_sides(options.inputs, options.outputs);
  for (const ResponseOutput& output : options.outputs) result.output_units.push_back(response.units(output));
  for (const double frequency : options.frequencies) {
    const ShiftedOperator D(equations, std::complex<double>(0, 2 * std::numbers::pi * frequency));
    if (!D.regular())
      throw ComputationError(fmt::format(
          "there is no response at {:.6g} Hz: it is a frequency at which the mechanism moves without any force",
          frequency));
    Eigen::MatrixXcd H(options.outputs.size(), options.inputs.size());
    for (std::size_t j = 0; j < rights.size(); ++j) {
      const Variation variation = response.answer(D, rights[j]);
      for (std::size_t i = 0; i < options.outputs.size(); ++i)
        H(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            response.value(options.outputs[i], variation) + response.direct(options.outputs[i], options.inputs[j]);
    }
    result.response.push_back(std::move(H));
  }
  return result;
}

}  // namespace bielle::mechanism
