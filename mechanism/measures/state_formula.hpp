// A user's formula of time, a component's own variables and measures of the state, for example for a force, a torque, a
// spring, a load or a valve.
//
// The component that owns the formula refers to its measures (References): their gradients are in the component's local
// layout, and the gradient of the formula is the sum of f_m dm.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mechanism/model/measure.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {

/// Value of a formula with its derivatives. The object is reused from call to call: it allocates memory only when it
/// grows.
class FormulaGradient {
 public:
  static constexpr std::size_t most_variables = 8;
  double value = 0;
  std::array<double, most_variables> by_variable{};  ///< derivatives by the component's own variables
  /// Derivatives through measures, over the component's local layout: by positions, amplitudes, first-order unknowns
  /// and multipliers, and by velocities and rates. They are empty if the formula has no measures.
  MeasureGradient by_state;
};

class StateFormula {
 public:
  StateFormula() = default;  ///< the formula 0
  explicit StateFormula(double constant) : expression_(constant) {}
  /// @param expression  expression of `own` variables, and of the measures
  /// @param measures    measures with their numbers among the references of the component that owns the formula
  struct Argument {
    const Measure* measure;
    int reference;
  };
  StateFormula(Expression expression, std::size_t own, std::vector<Argument> measures);

  bool reads_state() const { return !measures_.empty(); }
  bool reads_reactions() const;
  bool uses(std::size_t variable) const { return variable < own_ && expression_.uses(variable); }
  /// Whether its value changes with time at a constant state: through its own variable t, or through a measure.
  /// @param time  number of t among its own variables
  bool holds_time(std::size_t time = 0) const;
  bool is_constant() const { return expression_.is_constant(); }
  const std::string& text() const { return expression_.text(); }  ///< text as the user wrote it

  /// @param state  state of the component that owns the formula @param variables  values of its own variables, in the
  ///               order of the reader
  double value(const LocalState& state, std::span<const double> variables) const;
  void calc(const LocalState& state, std::span<const double> variables, FormulaGradient& gradient) const;
  /// Adds the values of one of its own variables at which the formula may have kinks.
  void add_break_points(std::size_t variable, std::vector<double>& points) const;

 private:
  static constexpr std::size_t most_arguments = 64;
  Expression expression_;
  std::size_t own_ = 0;
  std::vector<Argument> measures_;
};

}  // namespace bielle::mechanism
