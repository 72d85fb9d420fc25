// A parsed formula as a tree, with its value, its exact first and second derivatives, and the positions of its kinks.
//
// Derivatives are computed by forward propagation of jets (f, df/dx, d2f/dx2) along one argument x, so that they are as
// exact as the value. At a kink or a jump the jet is the one on the right: a comparison, or |a| at a = 0, takes the
// sign that its argument has for x + 0. First derivatives along all arguments come from one evaluation with dual
// numbers, except at a kink.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "reduce/common/formula/formula_number.hpp"
#include "reduce/common/formula/interpolation.hpp"
#include "reduce/common/formula/surface.hpp"

namespace bielle {

enum class Operation {
  // leaves
  constant,
  argument,
  // one operand
  negate,
  logical_not,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  exp,
  ln,
  log2,
  log10,
  sqrt,
  abs,
  sign,
  floor,
  ceil,
  round,
  interpolate,
  // two operands
  on_surface,
  add,
  subtract,
  multiply,
  divide,
  power,
  atan2,
  modulo,
  minimum,
  maximum,
  less,
  less_or_equal,
  greater,
  greater_or_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  // three operands
  select,  ///< if(condition, a, b)
  step,    ///< 0 before t0, 10 s^3 - 15 s^4 + 6 s^5, 1 after t1
  ramp,    ///< 0 before t0, straight, 1 after t1
  pulse,   ///< 1 for t0 <= t < t1, else 0
};

class FormulaTree {
 public:
  struct Term {
    Operation operation;
    std::array<int, 3> operand;
    double number = 0;  ///< value of a constant
    int index = 0;      ///< index of an argument, an interpolation or a surface
  };

  /// Each function returns the index of the new term; operands are indices of earlier terms.
  int add_constant(double value);
  int add_argument(int index);
  int add_interpolation(std::shared_ptr<const Interpolation> function, int operand);
  int add_surface(std::shared_ptr<const Surface> function, int first, int second);
  int add(Operation operation, int first, int second = -1, int third = -1);

  /// Declares a term to be the value of the formula, and replaces constant parts by their values.
  /// @throws FormulaError if a constant part that is always evaluated has no value (`1/0`, `step(t, 2, 1)`)
  void set_root(int root);

  /// @throws FormulaError
  double value(std::span<const double> arguments) const;
  /// @param count  number of arguments, from `along` on, that grow together at the rate 1
  Jet jet(std::span<const double> arguments, std::size_t along, std::size_t count = 1) const;
  /// Computes the value and its first derivatives along the first arguments, as many as `gradient` has entries; they
  /// equal those of `jet`.
  double value_and_gradient(std::span<const double> arguments, std::span<double> gradient) const;
  bool is_constant() const { return !depends_on_arguments(root_); }
  bool uses(int argument) const { return depends_on(root_, argument); }
  /// Adds the values of one argument at which there is a kink or jump, if they can be found in advance: the compared
  /// quantity must depend on this argument alone, and linearly.
  void add_break_points(int argument, std::vector<double>& points) const { add_break_points(root_, argument, points); }

  // -- structure. Constant parts are constant terms, except within branches that may never be evaluated.
  int root() const { return root_; }
  const Term& term(int index) const { return terms_[static_cast<std::size_t>(index)]; }
  bool depends_on_arguments(int index) const { return depends_on(index, any_argument); }
  double constant_value(int index) const;  ///< value of a part without arguments. @throws FormulaError

 private:
  struct Linear {
    bool valid;
    double slope, offset;
  };
  static constexpr int any_argument = -1;
  template <class Number>
  struct Evaluation;

  static void check_transition(double t0, double t1);
  bool depends_on(int index, int argument) const;
  void fold(int index);
  Linear linear_in(int index, int argument) const;
  void add_break_points(int index, int argument, std::vector<double>& points) const;

  std::vector<Term> terms_;
  std::vector<std::shared_ptr<const Interpolation>> functions_;
  std::vector<std::shared_ptr<const Surface>> surfaces_;
  int root_ = -1;
};

}  // namespace bielle
