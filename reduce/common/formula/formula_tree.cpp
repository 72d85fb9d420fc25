#include "reduce/common/formula/formula_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace bielle {

using namespace formula_number;

namespace {

double elementary_value(Operation operation, double v) {
  switch (operation) {
    case Operation::sin:
      return std::sin(v);
    case Operation::cos:
      return std::cos(v);
    case Operation::tan:
      return std::tan(v);
    case Operation::asin:
      return std::asin(v);
    case Operation::acos:
      return std::acos(v);
    case Operation::atan:
      return std::atan(v);
    case Operation::sinh:
      return std::sinh(v);
    case Operation::cosh:
      return std::cosh(v);
    case Operation::tanh:
      return std::tanh(v);
    case Operation::asinh:
      return std::asinh(v);
    case Operation::acosh:
      return std::acosh(v);
    case Operation::atanh:
      return std::atanh(v);
    case Operation::exp:
      return std::exp(v);
    case Operation::ln:
      return std::log(v);
    case Operation::log2:
      return std::log2(v);
    case Operation::log10:
      return std::log10(v);
    default:
      return std::sqrt(v);
  }
}

/// Computes the same operations with derivatives. @param f  its value
template <class Number>
Number elementary_chain(Operation operation, const Number& x, double f) {
  const double v = value_of(x);
  const auto logarithm = [&](double scale) { return chain(x, f, scale / v, -scale / (v * v)); };
  switch (operation) {
    case Operation::sin:
      return chain(x, f, std::cos(v), -f);
    case Operation::cos:
      return chain(x, f, -std::sin(v), -f);
    case Operation::tan:
      return chain(x, f, 1 + f * f, 2 * f * (1 + f * f));
    case Operation::asin: {
      const double c = 1 - v * v;
      return chain(x, f, 1 / std::sqrt(c), v / (c * std::sqrt(c)));
    }
    case Operation::acos: {
      const double c = 1 - v * v;
      return chain(x, f, -1 / std::sqrt(c), -v / (c * std::sqrt(c)));
    }
    case Operation::atan:
      return chain(x, f, 1 / (1 + v * v), -2 * v / ((1 + v * v) * (1 + v * v)));
    case Operation::sinh:
      return chain(x, f, std::cosh(v), f);
    case Operation::cosh:
      return chain(x, f, std::sinh(v), f);
    case Operation::tanh:
      return chain(x, f, 1 - f * f, -2 * f * (1 - f * f));
    case Operation::asinh: {
      const double c = 1 + v * v;
      return chain(x, f, 1 / std::sqrt(c), -v / (c * std::sqrt(c)));
    }
    case Operation::acosh: {
      const double c = v * v - 1;
      return chain(x, f, 1 / std::sqrt(c), -v / (c * std::sqrt(c)));
    }
    case Operation::atanh: {
      const double c = 1 - v * v;
      return chain(x, f, 1 / c, 2 * v / (c * c));
    }
    case Operation::exp:
      return chain(x, f, f, f);
    case Operation::ln:
      return logarithm(1);
    case Operation::log2:
      return logarithm(1 / std::numbers::ln2);
    case Operation::log10:
      return logarithm(1 / std::numbers::ln10);
    default:
      return chain(x, f, 0.5 / f, -0.25 / (f * v));
  }
}

template <class Number>
Number elementary(Operation operation, const Number& x) {
  const double f = elementary_value(operation, value_of(x));
  if constexpr (std::is_same_v<Number, double>)
    return f;
  else
    return elementary_chain(operation, x, f);
}

}  // namespace

int FormulaTree::add_constant(double value) {
  terms_.push_back({Operation::constant, {-1, -1, -1}, value, 0});
  return static_cast<int>(terms_.size()) - 1;
}

int FormulaTree::add_argument(int index) {
  terms_.push_back({Operation::argument, {-1, -1, -1}, 0, index});
  return static_cast<int>(terms_.size()) - 1;
}

int FormulaTree::add_interpolation(std::shared_ptr<const Interpolation> function, int operand) {
  functions_.push_back(std::move(function));
  terms_.push_back({Operation::interpolate, {operand, -1, -1}, 0, static_cast<int>(functions_.size()) - 1});
  return static_cast<int>(terms_.size()) - 1;
}

int FormulaTree::add_surface(std::shared_ptr<const Surface> function, int first, int second) {
  surfaces_.push_back(std::move(function));
  terms_.push_back({Operation::on_surface, {first, second, -1}, 0, static_cast<int>(surfaces_.size()) - 1});
  return static_cast<int>(terms_.size()) - 1;
}

int FormulaTree::add(Operation operation, int first, int second, int third) {
  terms_.push_back({operation, {first, second, third}, 0, 0});
  return static_cast<int>(terms_.size()) - 1;
}

/// One evaluation of the tree; `Number` is double, Jet or Slopes.
///
/// With Slopes, the value decides at a border, and `at_kink` remembers that the slopes may belong to the wrong piece.
template <class Number>
struct FormulaTree::Evaluation {
  const FormulaTree& tree;
  std::span<const double> arguments;
  std::size_t along = 0;         ///< the first argument that is followed
  std::size_t count = 0;         ///< number of arguments that are followed: a Jet follows all of them as one, Slopes
                                 ///< each by itself
  mutable bool at_kink = false;  ///< of Slopes

  Number of(int index) const {
    const Number result = unchecked(tree.term(index));
    if (!std::isfinite(value_of(result))) throw FormulaError("the value is not a finite number");
    return result;
  }

 private:
  static constexpr bool has_slopes = std::is_same_v<Number, Slopes>;

  static Number constant(double value) { return Number(value); }
  static Number truth(bool value) { return constant(value ? 1 : 0); }

  Number argument(std::size_t index) const {
    const double value = arguments[index];
    if constexpr (std::is_same_v<Number, double>) {
      return value;
    } else {
      const bool is_followed = index >= along && index < along + count;
      if constexpr (has_slopes)
        return is_followed ? argument_with_slopes(value, index - along, count) : Slopes(value);
      else
        return formula_number::jet(value, is_followed ? 1 : 0, 0);
    }
  }

  /// Returns the sign of x - border immediately to the right of the point of evaluation.
  double side(const Number& x, const Number& border) const {
    if constexpr (has_slopes) {
      at_kink |= x.value == border.value && (varies(x) || varies(border));
      return formula_number::sign_of(x.value - border.value);
    } else {
      return formula_number::sign_of(x - border);
    }
  }
  double sign_of(const Number& x) const {
    if constexpr (has_slopes) {
      at_kink |= x.value == 0 && varies(x);
      return formula_number::sign_of(x.value);
    } else {
      return formula_number::sign_of(x);
    }
  }
  double floor_of(const Number& x) const {
    if constexpr (has_slopes) {
      const double whole = std::floor(x.value);
      at_kink |= whole == x.value && varies(x);
      return whole;
    } else {
      return formula_number::floor_of(x);
    }
  }
  Number interpolated(const Interpolation& function, const Number& x) const {
    bool from_right = true;
    if constexpr (has_slopes) {
      const auto points = function.points();
      at_kink |= function.kind() == Interpolation::Kind::linear && varies(x) &&
                 std::binary_search(points.begin(), points.end(), x.value);
    } else {
      from_right = rises(x);
    }
    const Interpolation::Values values = function(value_of(x), from_right);
    return chain(x, values.value, values.slope, values.curvature);
  }

  Number on_surface(const Surface& function, const Number& x, const Number& y) const {
    const double u = value_of(x), v = value_of(y);
    if constexpr (std::is_same_v<Number, double>) {
      return function(u, v).value;
    } else if constexpr (has_slopes) {
      const auto at_line = [](const Number& of, const Eigen::VectorXd& points) {
        return varies(of) && std::binary_search(points.begin(), points.end(), of.value);
      };
      at_kink |= function.kind() == Interpolation::Kind::linear &&
                 (at_line(x, function.x_points()) || at_line(y, function.y_points()));
      const Surface::Values z = function(u, v);
      return compose(x, y, z.value, z.x, z.y);
    } else {
      const Surface::Values z = function(u, v, rises(x), rises(y));
      const double x1 = first(x), y1 = first(y);
      return formula_number::jet(z.value, product(z.x, x1) + product(z.y, y1),
                                 product(z.xx, x1 * x1) + 2 * product(z.xy, x1 * y1) + product(z.yy, y1 * y1) +
                                     product(z.x, second(x)) + product(z.y, second(y)));
    }
  }

  bool is_true(int index) const { return sign_of(of(index)) != 0; }

  Number unchecked(const Term& term) const {
    const auto operand = [&](int k) { return of(term.operand[static_cast<std::size_t>(k)]); };
    const auto truth_of = [&](int k) { return is_true(term.operand[static_cast<std::size_t>(k)]); };
    switch (term.operation) {
      case Operation::constant:
        return constant(term.number);
      case Operation::argument:
        return argument(static_cast<std::size_t>(term.index));
      case Operation::negate:
        return -operand(0);
      case Operation::logical_not:
        return truth(!truth_of(0));
      case Operation::abs: {
        const Number x = operand(0);
        return sign_of(x) * x;
      }
      case Operation::sign:
        return constant(sign_of(operand(0)));
      case Operation::floor:
        return constant(floor_of(operand(0)));
      case Operation::ceil:
        return constant(-floor_of(-operand(0)));
      case Operation::round:
        return constant(floor_of(operand(0) + 0.5));
      case Operation::interpolate:
        return interpolated(*tree.functions_[static_cast<std::size_t>(term.index)], operand(0));
      default:
        return term.operand[1] < 0 ? elementary(term.operation, operand(0)) : of_several(term);
    }
  }

  /// Operations with two or three operands.
  Number of_several(const Term& term) const {
    const auto operand = [&](int k) { return of(term.operand[static_cast<std::size_t>(k)]); };
    const auto truth_of = [&](int k) { return is_true(term.operand[static_cast<std::size_t>(k)]); };
    const auto difference = [&] { return side(operand(0), operand(1)); };
    switch (term.operation) {
      case Operation::add:
        return operand(0) + operand(1);
      case Operation::subtract:
        return operand(0) - operand(1);
      case Operation::multiply:
        return operand(0) * operand(1);
      case Operation::divide:
        return over(operand(0), operand(1));
      case Operation::power:
        return power_of(operand(0), operand(1));
      case Operation::atan2:
        return atan2_of(operand(0), operand(1));
      case Operation::on_surface:
        return on_surface(*tree.surfaces_[static_cast<std::size_t>(term.index)], operand(0), operand(1));
      case Operation::modulo: {
        const Number a = operand(0), b = operand(1);
        return a - floor_of(over(a, b)) * b;
      }
      case Operation::minimum:
      case Operation::maximum: {
        const Number a = operand(0), b = operand(1);
        const bool first_is_greater = side(a, b) > 0;
        return first_is_greater == (term.operation == Operation::maximum) ? a : b;
      }
      case Operation::less:
        return truth(difference() < 0);
      case Operation::less_or_equal:
        return truth(difference() <= 0);
      case Operation::greater:
        return truth(difference() > 0);
      case Operation::greater_or_equal:
        return truth(difference() >= 0);
      case Operation::equal:
        return truth(difference() == 0);
      case Operation::not_equal:
        return truth(difference() != 0);
      case Operation::logical_and:
        return truth(truth_of(0) && truth_of(1));
      case Operation::logical_or:
        return truth(truth_of(0) || truth_of(1));
      case Operation::select:
        return operand(truth_of(0) ? 1 : 2);
      default:
        return transition(term.operation, operand(0), operand(1), operand(2));
    }
  }

  Number power_of(const Number& x, const Number& n) const {
    if (value_of(x) == 0 && value_of(n) < 0) throw FormulaError("division by zero");
    if (!varies(n)) return power(x, value_of(n));
    if constexpr (has_slopes) {
      at_kink |= !(x.value > 0);  // the jets decide whether the logarithm exists
      const double f = std::pow(x.value, n.value);
      return compose(x, n, f, n.value * std::pow(x.value, n.value - 1), f * std::log(x.value));
    }
    return elementary(Operation::exp, Number(n * elementary(Operation::ln, x)));
  }

  static Number atan2_of(const Number& y, const Number& x) {
    const double r2 = value_of(x) * value_of(x) + value_of(y) * value_of(y);
    const double angle = std::atan2(value_of(y), value_of(x));
    if constexpr (std::is_same_v<Number, double>) {
      return angle;
    } else if constexpr (has_slopes) {
      return compose(y, x, angle, x.value / r2, -y.value / r2);
    } else {
      // d angle = (x dy - y dx) / r2
      const Jet s = x * x + y * y;
      const double g = x.value * first(y) - y.value * first(x), g1 = x.value * second(y) - y.value * second(x);
      return formula_number::jet(angle, g / r2, (g1 - g * first(s) / r2) / r2);
    }
  }

  Number transition(Operation operation, const Number& t, const Number& t0, const Number& t1) const {
    check_transition(value_of(t0), value_of(t1));
    // On the border, the piece to the right of the argument is chosen.
    const double after_start = side(t, t0), after_end = side(t, t1);
    if (operation == Operation::pulse) return truth(after_start >= 0 && after_end < 0);
    if (after_start <= 0) return constant(0);
    if (after_end >= 0) return constant(1);
    const Number s = over<Number>(t - t0, t1 - t0);
    if (operation == Operation::ramp) return s;
    const double v = value_of(s), w = 1 - v;
    return chain(s, v * v * v * (10 + v * (6 * v - 15)), 30 * v * v * w * w, 60 * v * w * (1 - 2 * v));
  }
};

double FormulaTree::constant_value(int index) const { return Evaluation<double>{*this, {}}.of(index); }

double FormulaTree::value(std::span<const double> arguments) const {
  return Evaluation<double>{*this, arguments}.of(root_);
}

Jet FormulaTree::jet(std::span<const double> arguments, std::size_t along, std::size_t count) const {
  return Evaluation<Jet>{*this, arguments, along, count}.of(root_);
}

double FormulaTree::value_and_gradient(std::span<const double> arguments, std::span<double> gradient) const {
  if (gradient.empty()) return value(arguments);
  constexpr std::size_t most_slopes = Slopes::Gradient::MaxRowsAtCompileTime;
  double result = 0;
  for (std::size_t first = 0; first < gradient.size(); first += most_slopes) {
    const std::span<double> part = gradient.subspan(first, std::min(most_slopes, gradient.size() - first));
    const Evaluation<Slopes> evaluation{*this, arguments, first, part.size()};
    const Slopes found = evaluation.of(root_);
    result = found.value;
    bool as_jets = evaluation.at_kink;
    for (std::size_t i = 0; i < part.size(); ++i) {
      part[i] = varies(found) ? found.gradient[static_cast<Eigen::Index>(i)] : 0;
      as_jets |= !std::isfinite(part[i]);  // a jet has exact zeros for derivatives of constants
    }
    if (as_jets)
      for (std::size_t i = 0; i < part.size(); ++i) part[i] = formula_number::first(jet(arguments, first + i));
  }
  return result;
}

}  // namespace bielle
