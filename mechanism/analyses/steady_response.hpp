// Inputs and outputs of equations with constant coefficients, evaluated at the state of the linearisation.
#pragma once

#include "mechanism/analyses/linear_response.hpp"
#include "mechanism/solvers/linearised/variations.hpp"

namespace bielle::mechanism {

class SteadyResponse final : public LinearResponse {
 public:
  /// All arguments must outlive this object.
  SteadyResponse(const System& system, const State& state, const Environment& environment,
                 const LinearisedEquations& equations)
      : system_(system), state_(state), environment_(environment), equations_(equations) {}

  const LinearisedEquations& equations() const override { return equations_; }
  Eigen::VectorXcd values(const std::vector<ResponseOutput>& outputs, const LinearMotion& motion) const override;
  double direct(const ResponseOutput& output, const ResponseInput& input) const override;
  std::string units(const ResponseOutput& output) const override;
  VectorX right_side(const ResponseInput& input) const override;

 private:
  Complex value(const ResponseOutput& output, const Variation& variation) const;
  /// Inputs of the model and delayed values act through the forces that depend on them by formulas: the derivatives are
  /// central differences, exact if the formulas are linear.
  struct InputStep {
    int place;  ///< index in the state's memory
    double size;
  };
  InputStep step_of(const ResponseInput& input) const;
  State with(const InputStep& step, double steps) const;

  const System& system_;
  const State& state_;
  const Environment& environment_;
  const LinearisedEquations& equations_;
};

}  // namespace bielle::mechanism
