// Small motions about a state between inputs and outputs: right-hand sides and output values.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/analyses/standing_state.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/linearised/variations.hpp"

namespace bielle::mechanism {

class LinearResponse {
 public:
  using Complex = std::complex<double>;
  /// All arguments must outlive this object.
  LinearResponse(const System& system, const StandingState& about, const LinearisedEquations& equations)
      : system_(system), state_(about.state), environment_(about.environment), equations_(equations) {}

  /// Computes the derivatives of the residual by each input (n + constraints). @throws InputError for an input that
  /// acts on nothing
  std::vector<VectorX> right_sides(const std::vector<ResponseInput>& inputs,
                                   const std::vector<ResponseOutput>& outputs) const;
  /// Solves for the motion exp(shift t) due to a right-hand side.
  Variation answer(const ShiftedOperator& D, const VectorX& right) const;
  /// Returns the motion exp(s t) with given unknowns and multipliers (n + constraints).
  Variation motion(Complex s, const Eigen::VectorXcd& solution) const;
  /// Returns the variation of an output due to a motion.
  Complex value(const ResponseOutput& output, const Variation& variation) const;
  /// Returns the derivative of an output by an input of the model that it contains directly.
  double direct(const ResponseOutput& output, const ResponseInput& input) const;
  std::string units(const ResponseOutput& output) const;

 private:
  VectorX right_side(const ResponseInput& input) const;
  /// Inputs of the model act through the forces that depend on them by formulas: the derivatives are central
  /// differences, exact if the formulas are linear.
  struct InputStep {
    int place;  ///< index in the state's memory
    double size;
  };
  InputStep step_of(const std::string& name) const;
  State with(const InputStep& step, double steps) const;

  const System& system_;
  const State& state_;
  const Environment& environment_;
  const LinearisedEquations& equations_;
};

/// @throws InputError naming the nearest name
void check_response_names(const Model& model, const std::vector<ResponseInput>& inputs,
                          const std::vector<ResponseOutput>& outputs);

}  // namespace bielle::mechanism
