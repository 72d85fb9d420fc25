// Small motions about a state between inputs and outputs: right-hand sides and output values.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// A motion exp(s t) of all unknowns of linearised equations.
struct LinearMotion {
  Eigen::VectorXcd u, rate;     ///< (n) unknowns, and variations of their rates
  Eigen::VectorXcd multiplier;  ///< (constraints)
};

/// Linearised equations with inputs and outputs.
class LinearResponse {
 public:
  using Complex = std::complex<double>;
  virtual ~LinearResponse() = default;

  virtual const LinearisedEquations& equations() const = 0;
  /// Computes the derivatives of the residual by each input (n + constraints). @throws InputError for an input that
  /// acts on nothing
  std::vector<VectorX> right_sides(const std::vector<ResponseInput>& inputs,
                                   const std::vector<ResponseOutput>& outputs) const;
  /// Solves for the motion exp(shift t) due to a right-hand side.
  LinearMotion answer(const ShiftedOperator& D, const VectorX& right) const;
  /// Returns the motion exp(s t) with given unknowns and multipliers (n + constraints).
  LinearMotion motion(Complex s, const Eigen::VectorXcd& solution) const;
  /// Returns the variations of outputs due to a motion.
  virtual Eigen::VectorXcd values(const std::vector<ResponseOutput>& outputs, const LinearMotion& motion) const = 0;
  /// Returns the derivative of an output by an input of the model that appears in it directly.
  virtual double direct(const ResponseOutput& output, const ResponseInput& input) const = 0;
  virtual std::string units(const ResponseOutput& output) const = 0;
  /// Returns the response (outputs, inputs) at the shift, with the outputs' direct dependence on inputs.
  /// @param rights  right_sides of the inputs
  Eigen::MatrixXcd at(const ShiftedOperator& D, const std::vector<ResponseInput>& inputs,
                      const std::vector<ResponseOutput>& outputs, const std::vector<VectorX>& rights) const;

 private:
  virtual VectorX right_side(const ResponseInput& input) const = 0;
};

/// Checks that the model has the inputs and outputs. @throws InputError naming the nearest name
void check_response_names(const Model& model, const std::vector<ResponseInput>& inputs,
                          const std::vector<ResponseOutput>& outputs);

}  // namespace bielle::mechanism
