#include "reduce/common/formula_tree.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>

#include <fmt/format.h>

namespace bielle {

namespace {

/// a * b where a zero wins against an infinite other factor: what does not vary contributes no derivative.
double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

/// Sign of x on the right of the point of evaluation.
double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double sign_of(const Jet& x) {
  return x.value != 0 ? sign_of(x.value) : x.first != 0 ? sign_of(x.first) : sign_of(x.second);
}

double value_of(double x) { return x; }
double value_of(const Jet& x) { return x.value; }

/// x moves to the right of its value: then what is piecewise takes the piece on the right.
bool rises(double) { return true; }
bool rises(const Jet& x) { return x.first != 0 ? x.first > 0 : x.second >= 0; }

// f(x) by the chain rule from f, f' and f'' at x.
double chain(double, double f, double, double) { return f; }
Jet chain(const Jet& x, double f, double f1, double f2) {
  return {f, product(f1, x.first), product(f2, x.first * x.first) + product(f1, x.second)};
}

double plus(double a, double b) { return a + b; }
Jet plus(const Jet& a, const Jet& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
double times(double a, double b) { return a * b; }
Jet times(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}
double scale(double factor, double a) { return factor * a; }
Jet scale(double factor, const Jet& a) { return {factor * a.value, factor * a.first, factor * a.second}; }
double minus(double a, double b) { return a - b; }
Jet minus(const Jet& a, const Jet& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }

bool varies(double) { return false; }
bool varies(const Jet& x) { return x.first != 0 || x.second != 0; }

double over(double a, double b) {
  if (b == 0) throw FormulaError("division by zero");
  return a / b;
}
Jet over(const Jet& a, const Jet& b) {
  const double q = over(a.value, b.value), q1 = (a.first - q * b.first) / b.value;
  return {q, q1, (a.second - 2 * q1 * b.first - q * b.second) / b.value};
}

/// Derivatives of x^n for a constant n; zero where the factor n (n - 1) ... is.
template <class Number>
Number power(const Number& x, double n) {
  const double v = value_of(x), f = std::pow(v, n);
  if constexpr (std::is_same_v<Number, double>)
    return f;
  else
    return chain(x, f, product(n, n == 1 ? 1 : std::pow(v, n - 1)),
                 product(n * (n - 1), n == 2 ? 1 : std::pow(v, n - 2)));
}

template <class Number>
Number elementary(Operation operation, const Number& x) {
  const double v = value_of(x), f = [&] {
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
  }();
  if constexpr (std::is_same_v<Number, double>) {
    return f;
  } else {
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
}

/// floor of the value on the right of x
template <class Number>
double floor_of(const Number& x) {
  const double v = std::floor(value_of(x));
  return v == value_of(x) && !rises(x) ? v - 1 : v;
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

int FormulaTree::add(Operation operation, int first, int second, int third) {
  terms_.push_back({operation, {first, second, third}, 0, 0});
  return static_cast<int>(terms_.size()) - 1;
}

/// One evaluation of the tree; `Number` is double or Jet.
template <class Number>
struct FormulaTree::Evaluation {
  const FormulaTree& tree;
  std::span<const double> arguments;
  std::size_t along;

  Number of(int index) const {
    const Number result = unchecked(tree.term(index));
    if (!std::isfinite(value_of(result))) throw FormulaError("the value is not a finite number");
    return result;
  }

 private:
  static Number constant(double value) {
    if constexpr (std::is_same_v<Number, double>)
      return value;
    else
      return {value, 0, 0};
  }
  static Number truth(bool value) { return constant(value ? 1 : 0); }

  Number argument(std::size_t index) const {
    if constexpr (std::is_same_v<Number, double>)
      return arguments[index];
    else
      return {arguments[index], index == along ? 1.0 : 0.0, 0};
  }

  bool is_true(int index) const { return sign_of(of(index)) != 0; }

  Number unchecked(const Term& term) const {
    const auto operand = [&](int k) { return of(term.operand[static_cast<std::size_t>(k)]); };
    const auto truth_of = [&](int k) { return is_true(term.operand[static_cast<std::size_t>(k)]); };
    const auto difference = [&] { return sign_of(minus(operand(0), operand(1))); };
    switch (term.operation) {
      case Operation::constant:
        return constant(term.number);
      case Operation::argument:
        return argument(static_cast<std::size_t>(term.index));
      case Operation::negate:
        return scale(-1, operand(0));
      case Operation::logical_not:
        return truth(!truth_of(0));
      case Operation::abs: {
        const Number x = operand(0);
        return scale(sign_of(x), x);
      }
      case Operation::sign:
        return constant(sign_of(operand(0)));
      case Operation::floor:
        return constant(floor_of(operand(0)));
      case Operation::ceil:
        return constant(-floor_of(scale(-1, operand(0))));
      case Operation::round:
        return constant(floor_of(plus(operand(0), constant(0.5))));
      case Operation::interpolate: {
        const Number x = operand(0);
        const Interpolation& function = *tree.functions_[static_cast<std::size_t>(term.index)];
        const Interpolation::Values values = function(value_of(x), rises(x));
        return chain(x, values.value, values.slope, values.curvature);
      }
      case Operation::add:
        return plus(operand(0), operand(1));
      case Operation::subtract:
        return minus(operand(0), operand(1));
      case Operation::multiply:
        return times(operand(0), operand(1));
      case Operation::divide:
        return over(operand(0), operand(1));
      case Operation::power:
        return power_of(operand(0), operand(1));
      case Operation::atan2:
        return atan2_of(operand(0), operand(1));
      case Operation::modulo: {
        const Number a = operand(0), b = operand(1);
        return minus(a, scale(floor_of(over(a, b)), b));
      }
      case Operation::minimum:
      case Operation::maximum: {
        const Number a = operand(0), b = operand(1);
        const bool first_is_greater = sign_of(minus(a, b)) > 0;
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
      case Operation::step:
      case Operation::ramp:
      case Operation::pulse:
        return transition(term.operation, operand(0), operand(1), operand(2));
      default:
        return elementary(term.operation, operand(0));
    }
  }

  static Number power_of(const Number& x, const Number& n) {
    if (value_of(x) == 0 && value_of(n) < 0) throw FormulaError("division by zero");
    if (!varies(n)) return power(x, value_of(n));
    return elementary(Operation::exp, times(n, elementary(Operation::ln, x)));
  }

  static Number atan2_of(const Number& y, const Number& x) {
    const double r2 = value_of(x) * value_of(x) + value_of(y) * value_of(y);
    const double angle = std::atan2(value_of(y), value_of(x));
    if constexpr (std::is_same_v<Number, double>) {
      return angle;
    } else {
      // d angle = (x dy - y dx) / r2
      const Jet s = plus(times(x, x), times(y, y));
      const double g = x.value * y.first - y.value * x.first, g1 = x.value * y.second - y.value * x.second;
      return {angle, g / r2, (g1 - g * s.first / r2) / r2};
    }
  }

  static Number transition(Operation operation, const Number& t, const Number& t0, const Number& t1) {
    if (!(value_of(t0) < value_of(t1)))
      throw FormulaError(fmt::format("a step, ramp or pulse must end after its start, but runs from {} to {}",
                                     value_of(t0), value_of(t1)));
    // On the border, the piece on the right of the argument decides.
    const double after_start = sign_of(minus(t, t0)), after_end = sign_of(minus(t, t1));
    if (operation == Operation::pulse) return truth(after_start >= 0 && after_end < 0);
    if (after_start <= 0) return constant(0);
    if (after_end >= 0) return constant(1);
    const Number s = over(minus(t, t0), minus(t1, t0));
    if (operation == Operation::ramp) return s;
    const double v = value_of(s), w = 1 - v;
    return chain(s, v * v * v * (10 + v * (6 * v - 15)), 30 * v * v * w * w, 60 * v * w * (1 - 2 * v));
  }
};

void FormulaTree::set_root(int root) {
  root_ = root;
  fold(root);
}

double FormulaTree::value(std::span<const double> arguments) const {
  return Evaluation<double>{*this, arguments, 0}.of(root_);
}

Jet FormulaTree::jet(std::span<const double> arguments, std::size_t along) const {
  return Evaluation<Jet>{*this, arguments, along}.of(root_);
}

bool FormulaTree::is_constant() const { return !depends_on_arguments(root_); }

bool FormulaTree::depends_on_arguments(int index) const {
  if (index < 0) return false;
  const Term& t = term(index);
  if (t.operation == Operation::argument) return true;
  for (const int operand : t.operand)
    if (depends_on_arguments(operand)) return true;
  return false;
}

void FormulaTree::fold(int index) {
  Term& t = terms_[static_cast<std::size_t>(index)];
  if (t.operation == Operation::constant || t.operation == Operation::argument) return;
  if (t.operation == Operation::select) {
    fold(t.operand[0]);
    if (depends_on_arguments(t.operand[0])) return;  // a branch that is never taken may be without value
    const Term& condition = term(t.operand[0]);
    const int taken = condition.number != 0 ? t.operand[1] : t.operand[2];
    fold(taken);
    t = term(taken);
    return;
  }
  const bool second_may_be_skipped = t.operation == Operation::logical_and || t.operation == Operation::logical_or;
  for (std::size_t k = 0; k < (second_may_be_skipped ? 1U : 3U); ++k)
    if (t.operand[k] >= 0) fold(t.operand[k]);
  if (!depends_on_arguments(index)) {
    const double number = Evaluation<double>{*this, {}, 0}.of(index);
    t = {Operation::constant, {-1, -1, -1}, number, 0};
    return;
  }
  const auto constant = [&](std::size_t k) { return term(t.operand[k]).operation == Operation::constant; };
  const auto number = [&](std::size_t k) { return term(t.operand[k]).number; };
  if ((t.operation == Operation::divide || t.operation == Operation::modulo) && constant(1)) over(1, number(1));
  const bool transition =
      t.operation == Operation::step || t.operation == Operation::ramp || t.operation == Operation::pulse;
  if (transition && constant(1) && constant(2) && number(1) >= number(2))
    throw FormulaError(
        fmt::format("a step, ramp or pulse must end after its start, but runs from {} to {}", number(1), number(2)));
}

FormulaTree::Linear FormulaTree::linear_in(int index, int argument) const {
  const Term& t = term(index);
  const auto operand = [&](std::size_t k) { return linear_in(t.operand[k], argument); };
  const Linear no{false, 0, 0};
  switch (t.operation) {
    case Operation::constant:
      return {true, 0, t.number};
    case Operation::argument:
      return t.index == argument ? Linear{true, 1, 0} : no;
    case Operation::negate: {
      const Linear a = operand(0);
      return {a.valid, -a.slope, -a.offset};
    }
    case Operation::add:
    case Operation::subtract: {
      const Linear a = operand(0), b = operand(1);
      const double sign = t.operation == Operation::add ? 1 : -1;
      return {a.valid && b.valid, a.slope + sign * b.slope, a.offset + sign * b.offset};
    }
    case Operation::multiply: {
      const Linear a = operand(0), b = operand(1);
      if (!a.valid || !b.valid || (a.slope != 0 && b.slope != 0)) return no;
      return {true, a.slope * b.offset + a.offset * b.slope, a.offset * b.offset};
    }
    case Operation::divide: {
      const Linear a = operand(0), b = operand(1);
      if (!a.valid || !b.valid || b.slope != 0 || b.offset == 0) return no;
      return {true, a.slope / b.offset, a.offset / b.offset};
    }
    default:
      return no;
  }
}

void FormulaTree::add_break_points(int index, int argument, std::vector<double>& points) const {
  const Term& t = term(index);
  const auto where_zero = [&](Linear g) {
    if (g.valid && g.slope != 0) points.push_back(g.offset == 0 ? 0 : -g.offset / g.slope);
  };
  const auto where_equal = [&](std::size_t i, std::size_t k) {
    const Linear a = linear_in(t.operand[i], argument), b = linear_in(t.operand[k], argument);
    where_zero({a.valid && b.valid, a.slope - b.slope, a.offset - b.offset});
  };
  switch (t.operation) {
    case Operation::abs:
    case Operation::sign:
    case Operation::logical_not:
    case Operation::select:
      where_zero(linear_in(t.operand[0], argument));
      break;
    case Operation::logical_and:
    case Operation::logical_or:
      where_zero(linear_in(t.operand[0], argument));
      where_zero(linear_in(t.operand[1], argument));
      break;
    case Operation::minimum:
    case Operation::maximum:
    case Operation::less:
    case Operation::less_or_equal:
    case Operation::greater:
    case Operation::greater_or_equal:
    case Operation::equal:
    case Operation::not_equal:
      where_equal(0, 1);
      break;
    case Operation::step:
    case Operation::ramp:
    case Operation::pulse:
      where_equal(0, 1);
      where_equal(0, 2);
      break;
    case Operation::interpolate: {
      const Linear g = linear_in(t.operand[0], argument);
      const Interpolation& function = *functions_[static_cast<std::size_t>(t.index)];
      if (function.kind() == Interpolation::Kind::linear)
        for (const double x : function.points()) where_zero({g.valid, g.slope, g.offset - x});
      break;
    }
    default:
      break;
  }
  for (const int operand : t.operand)
    if (operand >= 0) add_break_points(operand, argument, points);
}

}  // namespace bielle
