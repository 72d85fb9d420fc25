// Formulas that users write: `2*pi*10`, `speed*t`, `step(t, 0, 0.1)`. Evaluated by muParser.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bielle {

/// Named constants that formulas may use, in SI.
using Parameters = std::map<std::string, double>;

/// A function of named variables.
///
/// Beside muParser's own operators and functions: `pi`, `if(c, a, b)`, `pow`, `mod`, `step(t, t0, t1)` (smooth from 0 to
/// 1, twice continuously differentiable), `ramp(t, t0, t1)`, `pulse(t, t0, t1)`, `table('file.csv', t)`. Anything that
/// muParser would accept silently and wrongly (`1,2`, a division by zero, an unknown name) throws InputError.
/// Copies are cheap to make and independent, so that each thread may evaluate its own.
class Expression {
 public:
  Expression();  ///< the constant 0
  explicit Expression(double constant);
  /// @param text       the formula
  /// @param variables  names of its arguments, in the order in which values are passed
  /// @param constants  the user's parameters
  /// @param folder     where `table('file.csv', t)` looks for relative file names
  /// @throws InputError without file or line (the caller knows them): what is wrong, at which character
  Expression(const std::string& text, const std::vector<std::string>& variables, const Parameters& constants = {},
             const std::string& folder = ".");
  Expression(const Expression&);
  Expression(Expression&&) noexcept;
  Expression& operator=(const Expression&);
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// @throws ComputationError when the value is not finite, naming the formula and the arguments
  double operator()(std::span<const double> values) const;
  double operator()(double value) const { return (*this)(std::span<const double>(&value, 1)); }

  /// Partial derivative of the given order (1 or 2) with respect to one argument, good to 1e-8 of the function's own
  /// scale of variation; one-sided at a break point, from the right.
  double derivative(std::span<const double> values, std::size_t argument, int order = 1) const;
  double derivative(double value, int order = 1) const {
    return derivative(std::span<const double>(&value, 1), 0, order);
  }

  bool is_constant() const;  ///< uses none of its variables
  const std::string& text() const;
  /// Arguments [in the first variable] at which the function or one of its first two derivatives may jump, ascending.
  std::vector<double> break_points() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bielle
