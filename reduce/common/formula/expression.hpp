// Formulas that users write: `2*pi*10`, `speed*t`, `step(t, 0, 0.1)`. muParser parses them; the tree that it builds
// gives the value and exact derivatives.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bielle {

class FormulaTree;
struct FormulaText;

/// Named constants that formulas may use, in SI.
using Parameters = std::map<std::string, double>;

/// A function of named variables. README.md lists the language: operators, functions, `pi`.
///
/// Transitions: `step(t, t0, t1)` rises from 0 to 1 as 10 s^3 - 15 s^4 + 6 s^5, twice continuously differentiable;
/// `ramp(t, t0, t1)` along a straight line; `pulse(t, t0, t1)` is 1 for t0 <= t < t1 and 0 elsewhere.
/// `table('file.csv', t)` joins the points of a two-column file by straight lines, `spline('file.csv', t)` by a cubic
/// spline; outside the file's range they throw. Input that muParser would accept silently and wrongly (`1,2`, `1/0`)
/// throws InputError. An expression is immutable: copies share it, and any number of threads may evaluate it.
class Expression {
 public:
  /// Upper bound of physical values: squares of it are still finite.
  static constexpr double most = 1e100;

  Expression();  ///< the constant 0
  explicit Expression(double constant);
  /// @param text       the formula
  /// @param variables  names of its arguments, in the order in which values are passed
  /// @param constants  the user's parameters
  /// @param folder     folder for relative file names in `table('file.csv', t)`
  /// @throws InputError without file or line (the caller adds them): the error and the position of its character
  Expression(const std::string& text, const std::vector<std::string>& variables, const Parameters& constants = {},
             const std::string& folder = ".");

  /// Makes a formula with references, which are further arguments after the variables, in the order of
  /// `text.references`. Messages contain the user's names of them.
  /// @param place  in a file, for messages: "crank.yaml:12: loads.push.force[3]"
  Expression(const FormulaText& text, const std::vector<std::string>& variables, const Parameters& constants = {},
             const std::string& folder = ".", const std::string& place = {});

  /// @param values  one for each variable. No memory is allocated.
  /// @throws ComputationError when the value, or any part of the formula that is needed for it, is not finite, or the
  ///         value is beyond `most`, naming the formula and the arguments
  double operator()(std::span<const double> values) const;
  double operator()(double value) const { return (*this)(std::span<const double>(&value, 1)); }

  /// Partial derivative of order 1 or 2 with respect to one argument, as accurate as the value; at a kink or jump it is
  /// the derivative on the right. @throws ComputationError if it does not exist (`sqrt(t)` at 0)
  double derivative(std::span<const double> values, std::size_t argument, int order = 1) const;
  double derivative(double value, int order = 1) const {
    return derivative(std::span<const double>(&value, 1), 0, order);
  }

  /// Computes the value and, in the same pass, the first derivatives with respect to all variables. They equal those of
  /// `derivative`; at a kink the cost is that of separate calls. No memory is allocated.
  /// @param gradient  one entry for each variable
  double value_and_gradient(std::span<const double> values, std::span<double> gradient) const;

  /// Tells whether the formula depends on a variable, as far as its structure shows: `0*t` uses t.
  bool uses(std::size_t argument) const;
  bool is_constant() const;         ///< uses none of its variables
  const std::string& text() const;  ///< text of the user
  /// Values of one argument at which the function or one of its first three derivatives may jump, ascending. They are
  /// found if the compared quantity depends on this argument alone and linearly (`2*t > 1`, `step(t, 0, 0.1)`, the
  /// points of a table), not in `sin(t) > 0`, `mod(t, 1)` or `floor(t)`, which have infinitely many.
  std::vector<double> break_points(std::size_t argument = 0) const;
  const FormulaTree& tree() const;  ///< for what reads its structure

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace bielle
